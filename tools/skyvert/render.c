/// `skyvert render`: one picture of the sky.
#include <string.h>
#include <strings.h>

#include "command.h"
#include "picture.h"

#define NAME "render"

typedef struct render_options {
    sky_options sky;
    moment_options when;
    picture_options picture;
    other_options other;
    const char *out;
} render_options;

enum { OPT_OUT = 1300 };

static const struct option long_options[] = {SKY_OPTIONS_LONG,
                                             MOMENT_OPTIONS_LONG,
                                             PICTURE_OPTIONS_LONG,
                                             OTHER_OPTIONS_LONG,
                                             {"out", required_argument, NULL, OPT_OUT},
                                             {"help", no_argument, NULL, 'h'},
                                             {NULL, 0, NULL, 0}};

static int print_help(void) {
    printf("usage: skyvert render --position TEXT --height-m M --utc TIME --out FILE.exr|FILE.png [OPTION...]\n\n"
           "A picture of the sky: EXR holds linear light (1 = 1000 cd/m2), PNG is exposed for the eye (sRGB).\n"
           "  --out FILE             ends in .exr or .png\n\n"
           "%s\n%s\n%s\n%s",
           moment_options_help, picture_options_help, light_options_help, sky_options_help);
    putchar('\n');
    other_options_print_help();
    return output_finish_stdout();
}

static int take(render_options *options, int c, char **argv) {
    if (c == OPT_OUT) {
        options->out = optarg;
        return 0;
    }
    int status = sky_options_take(&options->sky, c, optarg);
    if (status < 0)
        status = moment_options_take(&options->when, c, optarg);
    if (status < 0)
        status = picture_options_take(&options->picture, c, optarg);
    if (status < 0)
        status = other_options_take(&options->other, c, optarg);
    return status < 0 ? option_unknown(NAME, c, argv) : status;
}

static bool ends_in(const char *path, const char *ending) {
    const size_t n = strlen(path), m = strlen(ending);
    return n > m && strcasecmp(path + n - m, ending) == 0;
}

static int write_picture(const render_options *options, const picture *image, scene *view, const moment *now) {
    if (ends_in(options->out, ".exr"))
        return picture_write_exr(image, &options->picture, view, now, options->out);
    const bool auto_k = options->picture.exposure_auto;
    const double k = auto_k ? picture_auto_exposure(image) : options->picture.exposure;
    return picture_write_png(image, &options->picture, now, k, options->out);
}

static int draw(const render_options *options, scene *view, const moment *now) {
    picture image;
    int status = picture_render(&image, &options->picture, view, now, true);
    if (status != 0)
        return status;
    status = write_picture(options, &image, view, now);
    picture_free(&image);
    char text[400];
    if (status == 0 && options->sky.timing)
        fprintf(stderr, "%s\n", scene_timing(view, text, sizeof text));
    return status;
}

static int render(const render_options *options, const moment *now) {
    static scene view;
    static other_model other;
    const scene_plan plan = picture_plan(&options->picture);
    view.progress = true;
    int status = scene_begin(&view, &options->sky, now, &plan);
    if (status == 0 && options->other.model) {
        status = other_model_begin(&other, &options->other, &view, now->sun_enu);
        view.other = &other;
    }
    if (status == 0)
        status = draw(options, &view, now);
    other_model_end(&other);
    scene_end(&view);
    return status;
}

int cmd_render(int argc, char **argv) {
    static render_options options;
    sky_options_begin(&options.sky, NAME);
    moment_options_begin(&options.when, NAME);
    picture_options_begin(&options.picture, NAME);
    other_options_begin(&options.other, NAME);
    int status = 0;
    for (int c; status == 0 && (c = getopt_long(argc, argv, ":h", long_options, NULL)) != -1;) {
        if (c == 'h')
            return print_help();
        status = take(&options, c, argv);
    }
    moment now;
    if (status == 0)
        status = option_no_more(NAME, argc, argv);
    if (status == 0 && (!options.out || !(ends_in(options.out, ".exr") || ends_in(options.out, ".png"))))
        status = fail_usage("skyvert " NAME ": --out FILE: a name that ends in .exr or .png is needed");
    if (status == 0)
        status = picture_options_finish(&options.picture, 1024);
    if (status == 0)
        status = moment_options_finish(&options.when, options.sky.ground_m, &now);
    if (status == 0)
        status = other_options_finish(&options.other, &options.sky);
    if (status == 0)
        status = sky_options_finish(&options.sky);
    if (status != 0)
        return status;
    status = render(&options, &now);
    place_end();
    sky_options_free(&options.sky);
    return status;
}
