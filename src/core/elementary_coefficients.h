// Made by tools/fit/elementary.py: minimax polynomials of elementary.h. `make fit-check` compares.
#ifndef SKV_CORE_ELEMENTARY_COEFFICIENTS_H
#define SKV_CORE_ELEMENTARY_COEFFICIENTS_H

// 2^f = 1 + f(c0 + f(c1 + ..)), |f| <= 1/2; relative error 0.0001 before rounding of the steps.
#define SKV_EXP2_D3_0 0.693282902f
#define SKV_EXP2_D3_1 0.24221094f
#define SKV_EXP2_D3_2 0.0550090186f

// 2^f = 1 + f(c0 + f(c1 + ..)), |f| <= 1/2; relative error 2.8e-06 before rounding of the steps.
#define SKV_EXP2_D4_0 0.693124175f
#define SKV_EXP2_D4_1 0.240240917f
#define SKV_EXP2_D4_2 0.0559064932f
#define SKV_EXP2_D4_3 0.00958313607f

// 2^f = 1 + f(c0 + f(c1 + ..)), |f| <= 1/2; relative error 9.3e-08 before rounding of the steps.
#define SKV_EXP2_D5_0 0.693147004f
#define SKV_EXP2_D5_1 0.240222469f
#define SKV_EXP2_D5_2 0.0555071086f
#define SKV_EXP2_D5_3 0.00967129134f
#define SKV_EXP2_D5_4 0.00132695213f

// 2^f = 1 + f(c0 + f(c1 + ..)), |f| <= 1/2; relative error 3e-09 before rounding of the steps.
#define SKV_EXP2_D6_0 0.693147182f
#define SKV_EXP2_D6_1 0.240226477f
#define SKV_EXP2_D6_2 0.0555035993f
#define SKV_EXP2_D6_3 0.00961850584f
#define SKV_EXP2_D6_4 0.00133908063f
#define SKV_EXP2_D6_5 0.000153264715f

// log2(m) = s(c0 + z(c1 + ..)), s = (m-1)/(m+1), z = s^2; relative error 1.3e-08 before rounding of the steps.
#define SKV_LOG2_0 2.88539004f
#define SKV_LOG2_1 0.961821854f
#define SKV_LOG2_2 0.574598253f
#define SKV_LOG2_3 0.480097622f

// ln(m), the same form; relative error 8.1e-10 before rounding of the steps.
#define SKV_LOG_0 2.0f
#define SKV_LOG_1 0.666667759f
#define SKV_LOG_2 0.399775863f
#define SKV_LOG_3 0.298706949f

// erfcx(y) = t(c0 + t(c1 + ..)), t = 1/(1 + 0.563y); relative error 9e-05 before rounding of the steps.
#define SKV_ERFCX4_0 0.317610115f
#define SKV_ERFCX4_1 0.319999605f
#define SKV_ERFCX4_2 0.237387866f
#define SKV_ERFCX4_3 0.294903904f
#define SKV_ERFCX4_4 -0.169975221f

// erfcx(y) = t(c0 + t(c1 + ..)), t = 1/(1 + 0.395y); relative error 3.5e-06 before rounding of the steps.
#define SKV_ERFCX6_0 0.222854123f
#define SKV_ERFCX6_1 0.222963557f
#define SKV_ERFCX6_2 0.203027353f
#define SKV_ERFCX6_3 0.190861598f
#define SKV_ERFCX6_4 0.0450034775f
#define SKV_ERFCX6_5 0.217026934f
#define SKV_ERFCX6_6 -0.101740368f

// erfcx(y) = t(c0 + t(c1 + ..)), t = 1/(1 + 0.4y); relative error 1.3e-07 before rounding of the steps.
#define SKV_ERFCX8_0 0.225675866f
#define SKV_ERFCX8_1 0.225669473f
#define SKV_ERFCX8_2 0.207846135f
#define SKV_ERFCX8_3 0.168509126f
#define SKV_ERFCX8_4 0.141578645f
#define SKV_ERFCX8_5 -0.00595555315f
#define SKV_ERFCX8_6 0.169531584f
#define SKV_ERFCX8_7 -0.183194369f
#define SKV_ERFCX8_8 0.0503392182f

// sin(x) = x + xz(c0 + z(c1 + ..)), z = x^2, |x| <= pi/4; relative error 4e-09 before rounding of the steps.
#define SKV_SIN_0 -0.166666552f
#define SKV_SIN_1 0.00833218917f
#define SKV_SIN_2 -0.000195182918f

// cos(x) = 1 - z/2 + z^2(c0 + z(c1 + ..)); relative error 1.2e-10 before rounding of the steps.
#define SKV_COS_0 0.0416666456f
#define SKV_COS_1 -0.00138873095f
#define SKV_COS_2 2.44323273e-05f

// asin(x) = x + xz(c0 + z(c1 + ..)), |x| <= 1/2; relative error 4.9e-09 before rounding of the steps.
#define SKV_ASIN_0 0.166667521f
#define SKV_ASIN_1 0.0749530941f
#define SKV_ASIN_2 0.0454691537f
#define SKV_ASIN_3 0.0241847411f
#define SKV_ASIN_4 0.0421583988f

// atan(x) = x + xz(c0 + z(c1 + ..)), |x| <= tan(pi/8); relative error 2.1e-08 before rounding of the steps.
#define SKV_ATAN_0 -0.333329499f
#define SKV_ATAN_1 0.19977732f
#define SKV_ATAN_2 -0.138778776f
#define SKV_ATAN_3 0.0805428475f

// c of t = 1/(1 + c y).
#define SKV_ERFCX4_T 0.563f
#define SKV_ERFCX6_T 0.395f
#define SKV_ERFCX8_T 0.4f

#endif
