/// Atmosphere files of `skyvert eval --atmosphere` (and render, track): sections and keys as in README "Atmosphere
/// files".
#ifndef SKYVERT_INI_H
#define SKYVERT_INI_H

#include <stdio.h>

#include "skyvert/atmosphere.h"

typedef struct atmosphere_file {
    skv_atmosphere atmosphere; ///< its tables lie in `memory`
    char band_name[4][32];     ///< wavelengths as the file's numbers print: "440", "445.5"
    float *memory[8];          ///< owned: altitude and density of up to four tables
} atmosphere_file;

/// Reads and checks a file; what it returns is accepted by skv_model_build().
/// @return 0; 2 after one error line `file:line: what and what is allowed`; 1 iff this build lacks libinih. On error
///         nothing has to be freed.
int atmosphere_load(atmosphere_file *file, const char *path);
/// As atmosphere_load() from an open stream; path is for messages and the folder of tables.
int atmosphere_read(atmosphere_file *file, FILE *stream, const char *path);
void atmosphere_free(atmosphere_file *file);

#endif
