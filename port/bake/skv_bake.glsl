// Lookups in the tables of `skyvert bake`, GLSL ES 3.00 (WebGL 2) and later: the twin of skv_bake.h, where the mappings
// are explained. Put it behind #version and the precision statements (highp float, sampler2D, sampler3D).
//
// Textures: RGBA16F (RGB16F of three channels), filter GL_LINEAR without mipmaps, wrap GL_CLAMP_TO_EDGE, one texture per
// layer; sky-view, transmittance and irradiance 2-D (width x height), scattering-3d 3-D (width x height x depth).
// The numbers of the struct stand in the file under the same names. Values are texels/scale.
struct SkvBake {
    float radius_km;
    float top_km;
    float height_km;
    float mu_s_min;
    vec2 g;       // of layers 1 and 2: g_1, g_2
    ivec2 phase;  // 0 henyey-greenstein, 1 cornette-shanks
    int azimuths; // of scattering-3d
    vec4 scale;   // of the layers
};

// Position in n rows of a direction: mu = cosine, level = sine of its zenith angle.
float skv_bake_row(SkvBake t, float n, float altitude_km, float mu, float level) {
    float h = max(altitude_km, 0.0), r = t.radius_km + h, last = 0.5 * n - 1.0;
    float horizon = -sqrt(h * (t.radius_km + r)) / r, sine = t.radius_km / r;
    float sin_d = mu * sine - level * horizon, cos_d = level * sine + mu * horizon;
    if (sin_d >= 0.0) {
        float whole = sqrt(0.5 * (1.0 - horizon));
        if (h > t.top_km) { // the edge of the air
            float edge_level = (t.radius_km + t.top_km) / r;
            float edge_mu = -sqrt((h - t.top_km) * (t.radius_km + t.top_km + r)) / r;
            whole = (edge_mu * sine - edge_level * horizon) / sqrt(2.0 * (1.0 + edge_level * sine + edge_mu * horizon));
        }
        float chord = sin_d / sqrt(2.0 * clamp(1.0 + cos_d, 1e-6, 2.0));
        return last * (1.0 - sqrt(clamp(chord / whole, 0.0, 1.0)));
    }
    float shortest = max(altitude_km, 1e-6), longest = sqrt(shortest * (2.0 * t.radius_km + shortest));
    float root = sqrt(clamp(sin_d * (mu * sine + level * horizon), 0.0, 1.0));
    float along = longest * longest / ((t.radius_km + shortest) * (root - mu));
    return 0.5 * n + last * (1.0 - sqrt(clamp((along - shortest) / (longest - shortest), 0.0, 1.0)));
}

float skv_bake_azimuth(vec3 view, vec3 sun) {
    float v = length(view.xy), s = length(sun.xy);
    return v > 0.0 && s > 0.0 ? min(0.5 * distance(view.xy / v, sun.xy / s), 1.0) : 0.0;
}

float skv_bake_sun_g(float mu_s) {
    float w = 0.74 - sqrt(clamp(0.5 * (1.0 - mu_s), 0.0, 1.0));
    return w / (0.12 + abs(w));
}

float skv_bake_sun(SkvBake t, float mu_s) {
    float first = skv_bake_sun_g(t.mu_s_min);
    return clamp((skv_bake_sun_g(mu_s) - first) / (skv_bake_sun_g(1.0) - first), 0.0, 1.0);
}

float skv_bake_altitude(SkvBake t, float altitude_km) {
    return sqrt(clamp(altitude_km / t.top_km, 0.0, 1.0));
}

// Phase function that a deferred layer lacks, 1/sr.
float skv_bake_phase(SkvBake t, int layer, vec3 view, vec3 sun) {
    vec3 apart = view - sun;
    float away = clamp(0.5 * dot(apart, apart), 0.0, 2.0), nu = 1.0 - away, g = t.g[layer - 1];
    float d = g >= 0.0 ? (1.0 - g) * (1.0 - g) + 2.0 * g * away : (1.0 + g) * (1.0 + g) - 2.0 * g * (2.0 - away);
    float hg = (1.0 - g * g) / (d * sqrt(d)) * 0.0795774715;
    return t.phase[layer - 1] == 0 ? hg : hg * 1.5 * (1.0 + nu * nu) / (2.0 + g * g);
}

// sky-view: one layer (radiance, deferred ones, transmittance) at a unit direction, z up. With deferred phase functions
// radiance is layer 0 + skv_bake_phase(t, 1, view, sun) x layer 1 and so on.
vec4 skv_bake_sky_view(SkvBake t, highp sampler2D table, int layer, vec3 view, vec3 sun) {
    vec2 n = vec2(textureSize(table, 0));
    float x = skv_bake_azimuth(view, sun) * (n.x - 1.0);
    float y = skv_bake_row(t, n.y, t.height_km, view.z, length(view.xy));
    return textureLod(table, (vec2(x, y) + 0.5) / n, 0.0) / t.scale[layer];
}

// transmittance: from an altitude above the ground towards a zenith angle of cosine mu, to the top or the ground.
vec4 skv_bake_transmittance(SkvBake t, highp sampler2D table, float altitude_km, float mu) {
    vec2 n = vec2(textureSize(table, 0));
    float x = skv_bake_row(t, n.x, altitude_km, mu, sqrt(clamp((1.0 - mu) * (1.0 + mu), 0.0, 1.0)));
    float y = skv_bake_altitude(t, altitude_km) * (n.y - 1.0);
    return textureLod(table, (vec2(x, y) + 0.5) / n, 0.0) / t.scale[0];
}

// scattering-3d: one layer at an altitude above the ground and a unit direction, z up.
vec4 skv_bake_scattering(SkvBake t, highp sampler3D table, int layer, float altitude_km, vec3 view, vec3 sun) {
    vec3 n = vec3(textureSize(table, 0));
    float suns = n.x / float(t.azimuths);
    float a = skv_bake_azimuth(view, sun) * float(t.azimuths - 1), first = min(floor(a), float(t.azimuths - 2));
    float x = skv_bake_sun(t, sun.z) * (suns - 1.0) + first * suns;
    float y = skv_bake_row(t, n.y, altitude_km, view.z, length(view.xy));
    float z = skv_bake_altitude(t, altitude_km) * (n.z - 1.0);
    vec4 low = textureLod(table, (vec3(x, y, z) + 0.5) / n, 0.0);
    vec4 high = textureLod(table, (vec3(x + suns, y, z) + 0.5) / n, 0.0);
    return mix(low, high, a - first) / t.scale[layer];
}

// irradiance: one layer (0 facing up, 1 facing down, 2 facing the sun).
vec4 skv_bake_irradiance(SkvBake t, highp sampler2D table, int layer, float altitude_km, float mu_s) {
    vec2 n = vec2(textureSize(table, 0));
    vec2 at = vec2(skv_bake_sun(t, mu_s), skv_bake_altitude(t, altitude_km)) * (n - 1.0);
    return textureLod(table, (at + 0.5) / n, 0.0) / t.scale[layer];
}
