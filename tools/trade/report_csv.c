/// The reports for programs, and the worst inputs.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "report.h"

char *trade_row_ini(const trade *t, const trade_row *row, char text[400]) {
    if (row->config->terms == TRADE_ALL_TERMS)
        snprintf(text, 400, "%s", row->truth->ini);
    else
        snprintf(text, 400, "%.300s/%s%s.ini", t->options.out, row->truth->air, trade_terms_suffix[row->config->terms]);
    return text;
}

static const char *kind_of(const trade_config *c) {
    return !c->baseline ? "ours" : c->baseline->literal ? "baseline-literal" : "baseline";
}

/// A number, or nothing where it is negative: not measured.
static void number(FILE *out, double value) {
    if (value >= 0)
        fprintf(out, ",%.12g", value);
    else
        fputc(',', out);
}

static void scene_line(FILE *out, const trade *t, const trade_row *r, int k) {
    const trade_scene *const s = &r->truth->scene[k];
    const trade_error *const e = &r->error[k];
    const trade_cost *const c = &r->cost[k];
    char ini[400];
    fprintf(out, "\"%s\",%s,%s,%s,%s,%s,%d", r->config->name, kind_of(r->config), trade_light_name[r->config->light],
            r->truth->air, trade_sun_name[s->sun], trade_height_name[s->height], r->rays[k]);
    number(out, 100 * e->mean);
    number(out, 100 * e->p95);
    number(out, 100 * e->max);
    number(out, trade_cost_ns(r, k));
    number(out, c->ns);
    number(out, c->ns_low);
    number(out, c->ns_high);
    number(out, c->frame_ns < 0 ? -1 : 1e-3 * c->frame_ns);
    number(out, trade_cost_instructions(r, k));
    number(out, c->instructions);
    number(out, c->frame_instructions);
    number(out, r->table_bytes);
    number(out, r->grid_bytes);
    number(out, r->work_bytes);
    number(out, r->stack_bytes);
    number(out, r->build_s);
    fprintf(out, ",%d,%g,%g,%.4f,%.4f,%s,%s\n", r->config->exp_degree, s->height_km, s->sun_zenith_deg,
            s->view_zenith_deg[e->worst], s->azimuth_deg[e->worst], trade_row_ini(t, r, ini), r->config->eval);
}

void trade_report_csv(FILE *out, const trade *t) {
    fprintf(
        out,
        "configuration,kind,light,air,sun,height,rays,error_mean_percent,error_p95_percent,error_max_percent,"
        "ns_per_vertex_of_%d,vertex_ns_median,vertex_ns_p10,vertex_ns_p90,frame_us_median,instructions_per_vertex_of_%"
        "d,"
        "vertex_instructions,frame_instructions,table_bytes,grid_bytes,build_work_bytes,stack_bytes,build_s,exp_degree,"
        "altitude_km,sun_zenith_deg,worst_view_zenith_deg,worst_rel_azimuth_deg,atmosphere,eval_options\n",
        TRADE_DOME_VERTICES, TRADE_DOME_VERTICES);
    for (size_t i = 0; i < t->rows.n; i++)
        for (int k = 0; k < TRADE_SCENES; k++)
            if (t->rows.at[i].rays[k] > 0)
                scene_line(out, t, &t->rows.at[i], k);
}

static void frontier_lines(FILE *out, const trade *t, int light, int sun, int height, int *on_frontier) {
    trade_frontier(t, light, sun, height, on_frontier);
    for (size_t i = 0; i < t->n_configs; i++) {
        const trade_pooled p = trade_pool(t, i, sun, height, -1);
        if (t->configs[i].light != light || p.scenes == 0)
            continue;
        fprintf(out, "%s,%s,%s,\"%s\",%s,%d,%d", trade_light_name[light], trade_sun_name[sun],
                height < 0 ? "all" : trade_height_name[height], t->configs[i].name, kind_of(&t->configs[i]), p.scenes,
                t->rows.at[i].sees_ground);
        number(out, p.ns);
        number(out, p.instructions);
        fprintf(out, ",%s,%.12g,%.12g,%.12g,%d\n", t->counted ? "instructions" : "ns", 100 * p.mean, 100 * p.p95,
                100 * p.max, on_frontier[i]);
    }
}

void trade_report_frontier(FILE *out, const trade *t) {
    int *const on_frontier = calloc(t->n_configs, sizeof *on_frontier);
    if (!on_frontier)
        return;
    fprintf(out, "light,sun,height,configuration,kind,scenes,sees_ground,ns_per_vertex,instructions_per_vertex,cost,"
                 "error_mean_percent,error_p95_percent,error_max_percent,on_frontier\n");
    for (int light = 0; light < TRADE_LIGHTS; light++)
        for (int sun = 0; sun < TRADE_SUNS; sun++)
            for (int height = -1; height < TRADE_HEIGHTS; height++)
                frontier_lines(out, t, light, sun, height, on_frontier);
    free(on_frontier);
}

void trade_report_worst(FILE *out, const trade *t) {
    for (size_t i = 0; i < t->n_configs; i++) {
        const trade_pooled p = trade_pool(t, i, -1, -1, -1);
        if (p.scenes == 0)
            continue;
        const trade_row *const r = p.worst;
        const trade_scene *const s = &r->truth->scene[p.worst_scene];
        const size_t ray = r->error[p.worst_scene].worst;
        char ini[400];
        fprintf(out, "%.6g %% %s, %s: %s | %s | %g,%g,%.4f,%.4f | truth", 100 * p.max, t->configs[i].name,
                trade_light_name[t->configs[i].light], trade_row_ini(t, r, ini), t->configs[i].eval, s->height_km,
                s->sun_zenith_deg, s->view_zenith_deg[ray], s->azimuth_deg[ray]);
        for (int b = 0; b < r->truth->bands; b++)
            fprintf(out, "%c%.9g", b ? ',' : ' ', s->radiance[t->configs[i].light][ray][b]);
        fprintf(out, " | scale %.9g%s\n", r->off_scale[p.worst_scene],
                r->config->exp_degree != TRADE_EXP_DEGREE ? " | needs a core of that degree" : "");
    }
}

static int write_air(const trade *t, const trade_truth *truth, int terms) {
    char name[400], part[410], line[1024];
    snprintf(name, sizeof name, "%.300s/%s%s.ini", t->options.out, truth->air, trade_terms_suffix[terms]);
    snprintf(part, sizeof part, "%s.part", name);
    FILE *const in = fopen(truth->ini, "r"), *const out = fopen(part, "w");
    int keep = 1;
    while (in && out && fgets(line, sizeof line, in)) {
        if (line[0] == '[')
            keep = strncmp(line, "[ozone]", 7) != 0 &&
                   (terms != TRADE_GAS_ONLY || (strncmp(line, "[aerosol]", 9) != 0 && strncmp(line, "[dust]", 6) != 0));
        if (keep)
            fputs(line, out);
    }
    int good = in && out && !ferror(in) && !ferror(out);
    if (in)
        fclose(in);
    if (out)
        good = fclose(out) == 0 && good;
    good = good && rename(part, name) == 0;
    if (!good)
        fprintf(stderr, "%.300s: cannot be written\n", name);
    return good ? 0 : 1;
}

int trade_write_airs(const trade *t) {
    for (size_t a = 0; a < t->n_truths; a++)
        for (int terms = TRADE_NO_OZONE; terms < TRADE_TERM_SETS; terms++)
            if (write_air(t, &t->truths[a], terms))
                return 1;
    return 0;
}
