/// skyvert-reference: single scattering in double, with the query and answer form of `skyvert eval --orders single`.
#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "read_ini.h"

static const char *const columns[4] = {"altitude_km", "sun_zenith_deg", "view_zenith_deg", "rel_azimuth_deg"};

static int find_columns(char *header, int at[4]) {
    int found = 0, i = 0;
    header[strcspn(header, "\r\n")] = '\0';
    for (char *name = header; name; i++) {
        char *comma = strchr(name, ',');
        if (comma)
            *comma = '\0';
        for (int k = 0; k < 4; k++)
            if (strcmp(name, columns[k]) == 0)
                at[k] = i, found++;
        name = comma ? comma + 1 : NULL;
    }
    return found == 4;
}

static int read_query(const char *line, const int at[4], double query[4]) {
    int found = 0, i = 0;
    for (const char *field = line; field; i++) {
        char *end;
        const double value = strtod(field, &end);
        for (int k = 0; k < 4; k++)
            if (at[k] == i && end != field && isfinite(value))
                query[k] = value, found++;
        field = strchr(field, ',');
        field = field ? field + 1 : NULL;
    }
    return found == 4;
}

static int answer_all(const ref_atmosphere *a, int lit) {
    char line[4096];
    int at[4];
    if (!fgets(line, sizeof line, stdin) || !find_columns(line, at)) {
        fprintf(stderr, "stdin:1: the header must name altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg\n");
        return 2;
    }
    printf("altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg");
    for (int k = 0; k < a->bands; k++)
        printf(",L_%.9g", a->wavelength_nm[k]);
    printf("\n");
    for (int number = 2; fgets(line, sizeof line, stdin); number++) {
        double q[4];
        ref_answer answer;
        if (line[strspn(line, " \r\n")] == '\0')
            continue;
        if (!read_query(line, at, q)) {
            fprintf(stderr, "stdin:%d: four finite numbers are needed\n", number);
            return 2;
        }
        const ref_ray ray = ref_ray_from_angles(q[0] - a->ground_km, q[1], q[2], q[3]);
        if (ref_single(a, &ray, lit, NULL, &answer) != 0) {
            fprintf(stderr, "stdin:%d: did not converge (relative error %.1e)\n", number, answer.error);
            return 1;
        }
        printf("%.9g,%.9g,%.9g,%.9g", q[0], q[1], q[2], q[3]);
        for (int k = 0; k < a->bands; k++)
            printf(",%.12e", answer.radiance[k]);
        printf("\n");
    }
    return fflush(stdout) == 0 && !ferror(stdout) ? 0 : 1;
}

static int usage(FILE *out, int status) {
    fprintf(out, "usage: skyvert-reference --atmosphere FILE.ini [--ground none|lit] [--ground-km X] < queries.csv > "
                 "answers.csv\n"
                 "Single scattering in double precision, converged to 1e-9; the columns of skyvert eval.\n");
    return status;
}

int main(int argc, char **argv) {
    static const struct option options[] = {{"atmosphere", required_argument, 0, 'a'},
                                            {"ground", required_argument, 0, 'g'},
                                            {"ground-km", required_argument, 0, 'k'},
                                            {"help", no_argument, 0, 'h'},
                                            {0, 0, 0, 0}};
    static ref_file file;
    const char *name = NULL;
    int lit = 0, option;
    double ground_km = 0;
    while ((option = getopt_long(argc, argv, "", options, NULL)) != -1) {
        if (option == 'h')
            return usage(stdout, 0);
        else if (option == 'a')
            name = optarg;
        else if (option == 'k')
            ground_km = strtod(optarg, NULL);
        else if (option == 'g' && (strcmp(optarg, "none") == 0 || strcmp(optarg, "lit") == 0))
            lit = optarg[0] == 'l';
        else
            return usage(stderr, 2);
    }
    if (!name || optind != argc)
        return usage(stderr, 2);
    if (ref_read_ini(&file, name) != 0)
        return 2;
    file.atmosphere.ground_km = ground_km;
    return answer_all(&file.atmosphere, lit);
}
