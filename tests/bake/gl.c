/// gl PRESET FILE.raw16f LIMIT_MEAN LIMIT_C: the GLSL sampler in a real OpenGL ES 3 (EGL without a display), at some
/// thousand random places and directions, against skv_radiance() of all orders (mean error at most LIMIT_MEAN %) and
/// against the C sampler (largest error at most LIMIT_C %). Exit status 77 where there is no OpenGL ES 3.
#define EGL_EGLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>

#include "sky.h"

enum { FRAMES = 64, DIRECTIONS = 64, POINTS = FRAMES * DIRECTIONS };

/// One lookup.
typedef struct point {
    float view[3], altitude_km, sun[3], mu_s;
} point;

static void skip(const char *why) {
    printf("GLSL sampler: %s (Debian: libegl1 libgles2 libgl1-mesa-dri)\n", why);
    exit(77);
}

// ---- OpenGL

static void gl_begin(void) {
    static const EGLint config_wants[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    static const EGLint context_wants[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    const EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    EGLConfig config = NULL;
    EGLint count = 0;
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, NULL, NULL))
        skip("no EGL display without a screen");
    if (!eglBindAPI(EGL_OPENGL_ES_API) || !eglChooseConfig(display, config_wants, &config, 1, &count) || count < 1)
        skip("no OpenGL ES 3");
    const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, context_wants);
    if (context == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        skip("no OpenGL ES 3 context");
    printf("note: %s, %s\n", (const char *)glGetString(GL_VERSION), (const char *)glGetString(GL_RENDERER));
}

static GLuint shader(GLenum kind, int n, const char *const parts[]) {
    static char log[4000];
    const GLuint s = glCreateShader(kind);
    GLint ok = 0;
    glShaderSource(s, n, parts, NULL);
    glCompileShader(s);
    glGetShaderiv(s, GL_COMPILE_STATUS, &ok);
    glGetShaderInfoLog(s, sizeof log, NULL, log);
    if (!ok)
        fprintf(stderr, "%s\n", log);
    if (!ok)
        stop("a shader does not compile");
    return s;
}

static char *text_of(const char *path) {
    FILE *const f = fopen(path, "rb");
    char *const text = calloc(1, 65536);
    if (!f || !text || fread(text, 1, 65535, f) == 0)
        stop("cannot read port/bake/skv_bake.glsl");
    fclose(f);
    return text;
}

/// What an engine's shader would look like.
static const char head[] = "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"
                           "precision highp sampler3D;\n";
static const char body[] = "uniform SkvBake t;\nuniform int deferred;\nuniform sampler2D flat0, flat1, flat2;\n"
                           "uniform sampler3D deep0, deep1, deep2;\nin vec4 view_altitude, sun_mu;\nout vec4 value;\n"
                           "void main() {\n"
                           "    vec3 view = view_altitude.xyz, sun = sun_mu.xyz;\n"
                           "    float h = view_altitude.w;\n";
static const char *const lookups[4] = {
    "    value = skv_bake_sky_view(t, flat0, 0, view, sun);\n"
    "    if (deferred > 0) value += skv_bake_phase(t, 1, view, sun) * skv_bake_sky_view(t, flat1, 1, view, sun);\n"
    "    if (deferred > 1) value += skv_bake_phase(t, 2, view, sun) * skv_bake_sky_view(t, flat2, 2, view, sun);\n}\n",
    "    value = skv_bake_transmittance(t, flat0, h, view.z);\n}\n",
    "    value = skv_bake_scattering(t, deep0, 0, h, view, sun);\n"
    "    if (deferred > 0) value += skv_bake_phase(t, 1, view, sun) * skv_bake_scattering(t, deep1, 1, h, view, sun);\n"
    "    if (deferred > 1) value += skv_bake_phase(t, 2, view, sun) * skv_bake_scattering(t, deep2, 2, h, view, "
    "sun);\n}\n",
    "    value = skv_bake_irradiance(t, flat0, 0, h, sun_mu.w);\n}\n"};
static const char fragment[] =
    "#version 300 es\nprecision mediump float;\nout vec4 c;\nvoid main() { c = vec4(0.0); }\n";

static GLuint program_for(int what) {
    const char *const parts[4] = {head, text_of("port/bake/skv_bake.glsl"), body, lookups[what]};
    const char *const fragments[1] = {fragment}, *const out[1] = {"value"};
    const GLuint p = glCreateProgram();
    GLint ok = 0;
    glAttachShader(p, shader(GL_VERTEX_SHADER, 4, parts));
    glAttachShader(p, shader(GL_FRAGMENT_SHADER, 1, fragments));
    glBindAttribLocation(p, 0, "view_altitude");
    glBindAttribLocation(p, 1, "sun_mu");
    glTransformFeedbackVaryings(p, 1, out, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(p);
    glGetProgramiv(p, GL_LINK_STATUS, &ok);
    if (!ok)
        stop("the shaders do not link");
    glUseProgram(p);
    return p;
}

/// The texels go to the GPU as they lie in the file.
static void textures(const skv_bake_table *t, GLuint p) {
    static const char *const names[2][3] = {{"flat0", "flat1", "flat2"}, {"deep0", "deep1", "deep2"}};
    const int deep = t->what == SKV_BAKE_SCATTERING;
    const GLenum kind = deep ? GL_TEXTURE_3D : GL_TEXTURE_2D;
    for (int unit = 0; unit < 6; unit++) { // samplers of two kinds may not share a unit, used or not
        GLuint id;
        glUniform1i(glGetUniformLocation(p, names[unit / 3][unit % 3]), unit);
        const int layer = unit % 3;
        if (unit / 3 != deep || layer > t->deferred)
            continue;
        glGenTextures(1, &id);
        glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
        glBindTexture(kind, id);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
        const uint16_t *const texels = t->half + (size_t)layer * skv_bake_layer_values(t);
        const GLenum format = t->channels == 4 ? GL_RGBA : GL_RGB;
        const GLint inside = t->channels == 4 ? GL_RGBA16F : GL_RGB16F;
        if (deep)
            glTexImage3D(kind, 0, inside, t->width, t->height, t->depth, 0, format, GL_HALF_FLOAT, texels);
        else
            glTexImage2D(kind, 0, inside, t->width, t->height, 0, format, GL_HALF_FLOAT, texels);
        glTexParameteri(kind, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTexParameteri(kind, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        glTexParameteri(kind, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTexParameteri(kind, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        glTexParameteri(kind, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    }
}

static void uniforms(const skv_bake_table *t, GLuint p) {
    const struct {
        const char *name;
        float value;
    } numbers[] = {{"t.radius_km", t->radius_km},
                   {"t.top_km", t->top_km},
                   {"t.height_km", t->height_km},
                   {"t.mu_s_min", t->mu_s_min}};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        glUniform1f(glGetUniformLocation(p, numbers[i].name), numbers[i].value);
    glUniform2i(glGetUniformLocation(p, "t.phase"), t->phase[0], t->phase[1]);
    glUniform2f(glGetUniformLocation(p, "t.g"), t->g[0], t->g[1]);
    glUniform1i(glGetUniformLocation(p, "t.azimuths"), t->azimuths);
    glUniform1i(glGetUniformLocation(p, "deferred"), t->deferred);
    glUniform4fv(glGetUniformLocation(p, "t.scale"), 1, t->scale);
}

/// A complete framebuffer has to be bound, though nothing is drawn.
static void framebuffer(void) {
    GLuint fb, rb;
    glGenRenderbuffers(1, &rb);
    glBindRenderbuffer(GL_RENDERBUFFER, rb);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 1, 1);
    glGenFramebuffers(1, &fb);
    glBindFramebuffer(GL_FRAMEBUFFER, fb);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, rb);
}

static void gl_lookup(const skv_bake_table *t, const point *points, float (*got)[4]) {
    GLuint in, out, array;
    const GLuint p = program_for(t->what);
    framebuffer();
    textures(t, p);
    uniforms(t, p);
    glGenVertexArrays(1, &array);
    glBindVertexArray(array);
    glGenBuffers(1, &in);
    glBindBuffer(GL_ARRAY_BUFFER, in);
    glBufferData(GL_ARRAY_BUFFER, POINTS * sizeof *points, points, GL_STATIC_DRAW);
    for (GLuint a = 0; a < 2; a++) {
        glEnableVertexAttribArray(a);
        glVertexAttribPointer(a, 4, GL_FLOAT, GL_FALSE, sizeof *points, (const void *)(16 * (uintptr_t)a));
    }
    glGenBuffers(1, &out);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, out);
    glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, POINTS * 4 * sizeof(float), NULL, GL_DYNAMIC_READ);
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, POINTS);
    glEndTransformFeedback();
    const void *const mapped =
        glMapBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, POINTS * 4 * sizeof(float), GL_MAP_READ_BIT);
    if (!mapped || glGetError() != GL_NO_ERROR)
        stop("OpenGL reports an error");
    memcpy(got, mapped, POINTS * 4 * sizeof(float));
}

// ---- the same by the C sampler and directly

static void c_lookup(const skv_bake_table *t, const point *p, float got[4]) {
    if (t->what == SKV_BAKE_SKY_VIEW)
        skv_bake_sky_view(t, p->view, p->sun, got, NULL);
    else if (t->what == SKV_BAKE_TRANSMITTANCE)
        skv_bake_transmittance(t, p->altitude_km, p->view[2], got);
    else if (t->what == SKV_BAKE_SCATTERING)
        skv_bake_scattering(t, p->altitude_km, p->view, p->sun, got);
    else
        skv_bake_irradiance(t, 0, p->altitude_km, p->mu_s, got);
}

/// A frame of points: one altitude, one sun (of the table where it has one), directions. @return the dome's mean
static double make_frame(const skv_bake_table *t, const bake_sky *sky, uint64_t *state, point *points,
                         float (*want)[4]) {
    static float direction[DIRECTIONS][3], radiance[DIRECTIONS][4], through[DIRECTIONS][4];
    const int view = t->what == SKV_BAKE_SKY_VIEW;
    const double h = view ? (double)t->height_km : (double)t->top_km * pow(uniform(state), 3.0);
    const double zenith = view ? acos((double)t->mu_s) : DEGREE * 95.0 * uniform(state), azimuth = 6.0 * uniform(state);
    const double dip = acos((double)t->radius_km / ((double)t->radius_km + h));
    float sun[3];
    double mean = 0.0;
    toward(sun, zenith, azimuth);
    for (int i = 0; i < DIRECTIONS; i++)
        random_direction(state, dip, zenith, azimuth, direction[i]);
    sky_light(sky, view, (float)h, sun, DIRECTIONS, direction[0], radiance[0], through[0]);
    for (int i = 0; i < DIRECTIONS; i++) {
        memcpy(points[i].view, direction[i], sizeof direction[i]);
        memcpy(points[i].sun, sun, sizeof sun);
        points[i].altitude_km = (float)h;
        points[i].mu_s = sun[2];
        memcpy(want[i], t->what == SKV_BAKE_TRANSMITTANCE ? through[i] : radiance[i], sizeof want[i]);
        mean += most4(want[i]) / DIRECTIONS;
    }
    return t->what == SKV_BAKE_TRANSMITTANCE ? 20.0 : mean; // % of 1
}

int main(int argc, char **argv) {
    static point points[POINTS];
    static float want[POINTS][4], got[POINTS][4];
    static double mean[FRAMES];
    static bake_sky sky;
    errors direct = {0}, twin = {0};
    skv_bake_table table;
    uint64_t state = 2463534242u;
    if (argc != 5)
        stop("usage: gl PRESET FILE.raw16f LIMIT_MEAN LIMIT_C");
    gl_begin();
    sky_begin(&sky, argv[1], 1.0f);
    table_read(argv[2], &table);
    for (int f = 0; f < FRAMES; f++)
        mean[f] = make_frame(&table, &sky, &state, points + f * DIRECTIONS, want + f * DIRECTIONS);
    gl_lookup(&table, points, got);
    for (int i = 0; i < POINTS; i++) {
        float c[4];
        c_lookup(&table, &points[i], c);
        if (table.channels == 3) // a texture without alpha has alpha 1
            got[i][3] = 0.0f;
        errors_add(&twin, error_of(got[i], c, mean[i / DIRECTIONS]));
        if (table.what != SKV_BAKE_IRRADIANCE)
            errors_add(&direct, error_of(got[i], want[i], mean[i / DIRECTIONS]));
    }
    const char *const slash = strrchr(argv[2], '/'), *const file = slash ? slash + 1 : argv[2];
    const error_summary d = errors_sum(&direct), c = errors_sum(&twin);
    printf("figure: GLSL on %s: %d lookups, %.2g/%.2g/%.2g %% from direct evaluation, %.2g/%.2g/%.2g %% from the C "
           "sampler\n",
           file, POINTS, d.mean, d.p95, d.most, c.mean, c.p95, c.most);
    if (!(d.mean <= atof(argv[3])) || !(c.most <= atof(argv[4]))) {
        printf("FAILED: GLSL on %s: allowed is a mean of %s %% from direct evaluation, %s %% from the C sampler\n",
               file, argv[3], argv[4]);
        return 1;
    }
    return 0;
}
