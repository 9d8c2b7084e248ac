/// Between the library's atmosphere (floats) and the reference's (doubles).
#include "convert.h"

static void profile_to(const ref_profile *p, skv_profile *q, float *km, float *density) {
    *q = (skv_profile){.kind = (skv_profile_kind)p->kind};
    q->scale_height_km = (float)p->scale_km;
    q->background = (float)p->background;
    q->us76_a = (float)p->us76_a;
    q->us76_b = (float)p->us76_b;
    q->peak_km = (float)p->peak_km;
    q->half_width_km = (float)p->half_width_km;
    q->lognormal_mu = (float)p->lognormal_mu;
    q->lognormal_k = (float)p->lognormal_k;
    q->table_altitude_km = km;
    q->table_density = density;
    q->table_rows = (uint32_t)p->rows;
    for (int i = 0; i < p->rows; i++) {
        km[i] = (float)p->table_km[i];
        density[i] = (float)p->table_density[i];
    }
}

void ref_to_skyvert(const ref_atmosphere *a, skv_atmosphere *to, ref_float_tables *tables) {
    *to = (skv_atmosphere){.radius_km = (float)a->radius_km, .top_km = (float)a->top_km, .bands = a->bands};
    for (int i = 0; i < 4; i++) {
        to->wavelength_nm[i] = (float)a->wavelength_nm[i];
        to->solar_irradiance[i] = (float)a->irradiance[i];
        to->albedo[i] = (float)a->albedo[i];
        to->rayleigh_scattering_per_km[i] = (float)a->rayleigh_scattering[i];
        to->rayleigh_absorption_per_km[i] = (float)a->rayleigh_absorption[i];
        to->dust_scattering_per_km[i] = (float)a->dust_scattering[i];
        to->dust_extinction_per_km[i] = (float)a->dust_extinction[i];
        to->aerosol_scattering_per_km[i] = (float)a->aerosol_scattering[i];
        to->aerosol_extinction_per_km[i] = (float)a->aerosol_extinction[i];
        to->ozone_absorption_per_km[i] = (float)a->ozone_absorption[i];
        to->absorption_colour[i] = 1;
    }
    to->aerosol_phase = a->phase == REF_HENYEY_GREENSTEIN ? SKV_PHASE_HG : SKV_PHASE_CS;
    to->aerosol_g = (float)a->g;
    to->turbidity = 1;
    to->dust_phase = a->dust_phase == REF_HENYEY_GREENSTEIN ? SKV_PHASE_HG : SKV_PHASE_CS;
    to->dust_g = (float)a->dust_g;
    profile_to(&a->dust, &to->dust, tables->km[3], tables->density[3]);
    profile_to(&a->rayleigh, &to->rayleigh, tables->km[0], tables->density[0]);
    profile_to(&a->aerosol, &to->aerosol, tables->km[1], tables->density[1]);
    profile_to(&a->ozone, &to->ozone, tables->km[2], tables->density[2]);
}

static ref_profile profile_from(const skv_profile *q, double *km, double *density) {
    ref_profile p = {.kind = (ref_kind)q->kind, .scale_km = (double)q->scale_height_km};
    p.background = (double)q->background;
    p.us76_a = (double)q->us76_a;
    p.us76_b = (double)q->us76_b;
    p.peak_km = (double)q->peak_km;
    p.half_width_km = (double)q->half_width_km;
    p.lognormal_mu = (double)q->lognormal_mu;
    p.lognormal_k = (double)q->lognormal_k;
    p.table_km = km;
    p.table_density = density;
    p.rows = q->kind == SKV_PROFILE_TABLE ? (int)q->table_rows : 0;
    for (int i = 0; i < p.rows; i++) {
        km[i] = (double)q->table_altitude_km[i];
        density[i] = (double)q->table_density[i];
    }
    return p;
}

void ref_from_skyvert(const skv_atmosphere *from, double ground_km, ref_file *to) {
    ref_atmosphere *a = &to->atmosphere;
    *a = (ref_atmosphere){.bands = from->bands, .radius_km = (double)from->radius_km, .top_km = (double)from->top_km};
    a->ground_km = ground_km;
    for (int i = 0; i < from->bands; i++) {
        a->wavelength_nm[i] = (double)from->wavelength_nm[i];
        a->irradiance[i] = (double)from->solar_irradiance[i] * (double)from->absorption_colour[i];
        a->albedo[i] = (double)from->albedo[i];
        a->rayleigh_scattering[i] = (double)from->rayleigh_scattering_per_km[i];
        a->rayleigh_absorption[i] = (double)from->rayleigh_absorption_per_km[i];
        a->dust_scattering[i] = (double)from->dust_scattering_per_km[i] * (double)from->turbidity;
        a->dust_extinction[i] = (double)from->dust_extinction_per_km[i] * (double)from->turbidity;
        a->aerosol_scattering[i] = (double)from->aerosol_scattering_per_km[i] * (double)from->turbidity;
        a->aerosol_extinction[i] = (double)from->aerosol_extinction_per_km[i] * (double)from->turbidity;
        a->ozone_absorption[i] = (double)from->ozone_absorption_per_km[i];
    }
    a->phase = from->aerosol_phase == SKV_PHASE_HG ? REF_HENYEY_GREENSTEIN : REF_CORNETTE_SHANKS;
    a->g = (double)from->aerosol_g;
    a->dust_phase = from->dust_phase == SKV_PHASE_HG ? REF_HENYEY_GREENSTEIN : REF_CORNETTE_SHANKS;
    a->dust_g = (double)from->dust_g;
    a->dust = profile_from(&from->dust, to->table_km[3], to->table_density[3]);
    a->rayleigh = profile_from(&from->rayleigh, to->table_km[0], to->table_density[0]);
    a->aerosol = profile_from(&from->aerosol, to->table_km[1], to->table_density[1]);
    a->ozone = profile_from(&from->ozone, to->table_km[2], to->table_density[2]);
}
