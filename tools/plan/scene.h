/// Scene files of `skyvert plan`: what ranges a product draws. Keys and ranges: scene.c, and `skyvert plan --help`.
#ifndef TOOLS_PLAN_SCENE_H
#define TOOLS_PLAN_SCENE_H

#include <stdbool.h>

#include "skyvert/skyvert.h"
#include "tools/skyvert/ini.h"

typedef struct plan_range {
    double low, high;
} plan_range;

/// A range of visibilities is looked at in three: its ends and their geometric mean.
#define PLAN_AIRS_MAX 3

typedef struct plan_scene {
    int preset;               ///< skv_preset; -1: the file's air
    const char *planet;       ///< name of the preset or of the file, without its folders
    char planet_text[64];     ///< room for it
    atmosphere_file file;     ///< of preset -1
    plan_range height_m;      ///< of the observer above the sea
    double ground_m;          ///< of the ground above the sea
    plan_range sun_deg;       ///< geometric elevation
    plan_range visibility_km; ///< meteorological, at the sea; {0, 0}: the air as it is
    plan_range view_deg;      ///< elevation of the directions drawn
    bool terrain;             ///< ground lit, and rays that end on mountains
    plan_range terrain_km;    ///< how far these are
    double terrain_share;     ///< of the vertices
    bool stars;               ///< transmittance is wanted
} plan_scene;

/// Reads and checks a file. @return 0; 2 after one error line `file:line: what and what is allowed`; 1 iff this build
/// lacks libinih or memory ran out. On error nothing has to be freed.
int plan_scene_load(plan_scene *scene, const char *path);
void plan_scene_free(plan_scene *scene);

/// Airs of a scene: 1, or 3 where the visibility has a range.
int plan_airs(const plan_scene *scene);
/// One of them. @param bands  of a preset, 3 or 4; a file's air has its own. Tables of a file belong to the scene.
void plan_air(const plan_scene *scene, int which, int bands, skv_atmosphere *air);
/// Visibility of one of them, km; 0: the air as it is.
double plan_air_visibility_km(const plan_scene *scene, int which);

/// Extinction of gas and of particles at 550 nm at the sea, 1/km, linear between the bands.
double plan_gas_per_km(const skv_atmosphere *air);
double plan_particles_per_km(const skv_atmosphere *air);

/// Contrast that is just seen: visibility = -ln(.02)/extinction at 550 nm [Koschmieder24].
#define PLAN_KOSCHMIEDER 3.912

extern const char *const plan_preset_names[]; ///< in the order of skv_preset; NULL at the end

#endif
