/// Refraction. [Saemundsson86]: R = 1.02' / tan(h + 10.3/(h + 5.11)) for a geometric elevation h in degrees, at 1010
/// hPa and 10 C; scaled with the density of the air [Meeus98] ch. 16.
#include "scene/ephemeris.h"

/// Where the formula ends and where the fade below it ends; geometric elevation, deg.
#define FORMULA_END_DEG (-1.0f)
#define FADE_END_DEG    (-5.0f)

/// At the zenith the formula is 0.002' below 0; it stays at 0 there.
static float saemundsson_deg(float h) {
    const skv_sincos angle = skv_sincosf((h + 10.3f / (h + 5.11f)) * SKV_RAD_PER_DEG);
    return skv_maxf(1.02f / 60.0f * angle.cos / angle.sin, 0.0f);
}

float skv_refraction_deg(float elevation_deg, float pressure_hpa, float temperature_c) {
    const int ok = elevation_deg >= -90.0f && elevation_deg <= 90.0f && pressure_hpa >= 0.0f &&
                   pressure_hpa <= 2000.0f && temperature_c >= -100.0f && temperature_c <= 100.0f;
    if (!ok || elevation_deg <= FADE_END_DEG)
        return 0.0f;
    const float scale = pressure_hpa / 1010.0f * (283.0f / (273.0f + temperature_c));
    if (elevation_deg >= FORMULA_END_DEG)
        return scale * saemundsson_deg(elevation_deg);
    const float fade = (elevation_deg - FADE_END_DEG) / (FORMULA_END_DEG - FADE_END_DEG);
    return scale * saemundsson_deg(FORMULA_END_DEG) * fade;
}
