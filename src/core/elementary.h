/// Elementary functions of the core: + - * / and sqrt only, so every target gives the same bits.
#ifndef SKV_CORE_ELEMENTARY_H
#define SKV_CORE_ELEMENTARY_H
#endif
