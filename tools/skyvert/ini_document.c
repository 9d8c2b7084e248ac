/// Feeds libinih line by line, so that a line may have any length (packages of libinih stop at 200 bytes), every
/// message has its line, and empty sections are seen.
#include "ini_document.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

void ini_free(ini_document *document) {
    for (size_t i = 0; i < document->entries; i++) {
        free(document->entry[i].section);
        free(document->entry[i].name);
        free(document->entry[i].value);
    }
    for (size_t i = 0; i < document->sections; i++)
        free(document->section[i].name);
    free(document->entry);
    free(document->section);
    *document = (ini_document){0};
}

const ini_section *ini_find_section(const ini_document *document, const char *name) {
    for (size_t i = 0; i < document->sections; i++)
        if (strcmp(document->section[i].name, name) == 0)
            return &document->section[i];
    return NULL;
}

const ini_entry *ini_find(const ini_document *document, const char *section, const char *name) {
    for (size_t i = 0; i < document->entries; i++)
        if (strcmp(document->entry[i].section, section) == 0 && strcmp(document->entry[i].name, name) == 0)
            return &document->entry[i];
    return NULL;
}

void ini_fail(ini_taker *r, int line, const char *format, ...) {
    char text[600];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (!r->result)
        r->result = fail_usage("%.200s:%d: %s", r->document->path, line, text);
}

static const ini_known *find_known(const ini_known *known, int n, const char *section) {
    for (int i = 0; i < n; i++)
        if (strcmp(known[i].section, section) == 0)
            return &known[i];
    return NULL;
}

static void check_section(ini_taker *r, const ini_section *section, const ini_known *known, int n) {
    char allowed[300] = "";
    for (int i = 0; i < n; i++) {
        const size_t used = strlen(allowed);
        snprintf(allowed + used, sizeof allowed - used, "%s[%s]",
                 i == 0      ? ""
                 : i + 1 < n ? ", "
                             : " and ",
                 known[i].section);
    }
    if (!find_known(known, n, section->name))
        ini_fail(r, section->line, "unknown section [%.40s]; allowed are %s", section->name, allowed);
}

static void check_key(ini_taker *r, const ini_entry *e, const ini_known *known) {
    char allowed[300] = "";
    for (int k = 0; known && known->keys[k]; k++) {
        if (strcmp(known->keys[k], e->name) == 0)
            return;
        const size_t used = strlen(allowed);
        snprintf(allowed + used, sizeof allowed - used, "%s%s", k ? ", " : "", known->keys[k]);
    }
    ini_fail(r, e->line, "unknown key %.60s in [%.40s]; allowed are %s", e->name, e->section, allowed);
}

void ini_check_names(ini_taker *r, const ini_known *known, int n) {
    const ini_document *const d = r->document;
    for (size_t i = 0; i < d->sections; i++)
        check_section(r, &d->section[i], known, n);
    for (size_t i = 0; i < d->entries && !r->result; i++)
        check_key(r, &d->entry[i], find_known(known, n, d->entry[i].section));
}

const ini_entry *ini_want(ini_taker *r, const char *section, const char *key, bool needed) {
    if (r->result)
        return NULL;
    const ini_entry *const e = ini_find(r->document, section, key);
    const ini_section *const s = ini_find_section(r->document, section);
    if (!e && needed && !s)
        ini_fail(r, r->document->lines > 0 ? r->document->lines : 1, "section [%s] is missing: %s is needed", section,
                 key);
    else if (!e && needed)
        ini_fail(r, s->line, "[%s] lacks %s; it is needed here", section, key);
    return e;
}

char *ini_beside(const ini_document *document, const char *name) {
    const char *const from = document->path, *const slash = strrchr(from, '/');
    const int folder = slash && name[0] != '/' ? (int)(slash - from) + 1 : 0;
    const size_t size = (size_t)folder + strlen(name) + 1;
    char *const path = malloc(size);
    if (path)
        snprintf(path, size, "%.*s%s", folder, from, name);
    return path;
}

#if SKV_HAVE_INIH
#include <ini.h>

#define LINE_BYTES 65536
#define LIST_MAX   1000 ///< a real file has some thirty entries

/// What the reader and the handler share.
typedef struct feed {
    ini_document *document;
    FILE *stream;
    char line[LINE_BYTES];
    const char *rest; ///< of a long line, still to be fed
    bool expects;     ///< what was fed last must reach the handler
    bool continues;   ///< ... as more of the value before it
    bool joined;      ///< ... without a blank between: pieces of one line
    int result;       ///< 0, or the exit status after an error line
} feed;

static bool fail_at(feed *f, const char *what) {
    if (!f->result)
        f->result = fail_usage("%.200s:%d: %s", f->document->path, f->document->lines, what);
    return false;
}

static bool out_of_memory(feed *f) {
    if (!f->result)
        f->result = fail_job("out of memory");
    return false;
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// Reads a line without its end. @return false at the end of the file or after an error line
static bool read_line(feed *f) {
    size_t length = 0;
    int c = getc(f->stream);
    if (c != EOF)
        f->document->lines++;
    for (; c != EOF && c != '\n'; c = getc(f->stream)) {
        if (c < 0x20 && c != '\t' && c != '\r')
            return fail_at(f, "binary data; a text file is needed");
        if (length + 1 >= sizeof f->line)
            return fail_at(f, "the line is too long; allowed are 65535 bytes");
        f->line[length++] = (char)c;
    }
    f->line[length] = '\0';
    if (ferror(f->stream)) {
        f->result = fail_usage("%.200s: cannot be read: %s", f->document->path, strerror(errno));
        return false;
    }
    return c != EOF || length > 0;
}

/// Cuts a byte order mark, comments and the blanks around the text, as libinih does, before a long line is cut in
/// pieces.
static char *trim(feed *f, bool *indented) {
    char *c = f->line;
    if (f->document->lines == 1 && strncmp(c, "\xEF\xBB\xBF", 3) == 0)
        c += 3;
    *indented = is_blank(*c);
    while (is_blank(*c))
        c++;
    if (*c == ';' || *c == '#')
        *c = '\0';
    for (char *p = c; *p; p++)
        if (*p == ';' && p > c && is_blank(p[-1]))
            *p = '\0';
    for (size_t n = strlen(c); n > 0 && is_blank(c[n - 1]); n--)
        c[n - 1] = '\0';
    return c;
}

/// Room for one more. @return NULL iff memory ran out
static void *grow(void *list, size_t count, size_t size) {
    return count % 16 ? list : realloc(list, (count + 16) * size);
}

static bool add_section(feed *f, char *name) {
    ini_document *const d = f->document;
    const ini_section *const before = ini_find_section(d, name);
    if (before) {
        f->result = fail_usage("%.200s:%d: section [%s] stands in line %d already; allowed is once", d->path, d->lines,
                               name, before->line);
        return false;
    }
    if (d->sections >= LIST_MAX)
        return fail_at(f, "too many sections");
    ini_section *const list = grow(d->section, d->sections, sizeof *list);
    if (!list)
        return out_of_memory(f);
    d->section = list;
    d->section[d->sections] = (ini_section){strdup(name), d->lines};
    return d->section[d->sections].name ? ++d->sections > 0 : out_of_memory(f);
}

static bool note_section(feed *f, char *c) {
    char *const close = strchr(c, ']');
    if (!close || close[1] != '\0' || close - c > 40)
        return fail_at(f, "not a section; allowed is a name in brackets, like [planet]");
    *close = '\0';
    const bool ok = add_section(f, c + 1);
    *close = ']';
    return ok;
}

/// Runs of blanks to one: only for lines that libinih does not take whole, names of files may hold runs.
static void squeeze(char *text) {
    char *to = text;
    for (const char *c = text; *c; c++)
        if (!is_blank(*c) || !is_blank(c[1]))
            *to++ = *c;
    *to = '\0';
}

/// libinih drops blanks and comments at the ends of a piece: those places are no place to cut.
static bool may_cut(const char *c) {
    return !strchr(" \t;#", c[-1]) && !strchr(" \t;#", c[0]);
}

/// Gives libinih as much of f->rest as its buffer takes; a leading blank is its mark of a continuation.
static char *feed_piece(feed *f, char *buffer, size_t size) {
    const size_t length = strlen(f->rest);
    size_t take = length;
    if (length + 3 > size)
        for (take = size - 3; take > 1 && !may_cut(f->rest + take); take--) {
        }
    if (take == 1 && length > 1) {
        fail_at(f, "the line is too long");
        return NULL;
    }
    char *c = buffer;
    if (f->continues)
        *c++ = ' ';
    memcpy(c, f->rest, take);
    memcpy(c + take, "\n", 2);
    f->rest = take < length ? f->rest + take : NULL;
    return buffer;
}

/// The reader that libinih calls (as fgets).
static char *feed_line(char *buffer, int size, void *stream) {
    feed *const f = stream;
    bool indented;
    if (f->expects)
        fail_at(f, "no value; allowed is name = value, [section] or a comment behind ; or #");
    if (f->result)
        return NULL;
    if (f->rest) {
        f->expects = f->continues = f->joined = true;
        return feed_piece(f, buffer, (size_t)size);
    }
    if (!read_line(f))
        return NULL;
    char *const c = trim(f, &indented);
    if (strlen(c) + 3 > (size_t)size)
        squeeze(c);
    f->rest = c;
    f->joined = f->continues = f->expects = false;
    if (*c == '[')
        return note_section(f, c) ? feed_piece(f, buffer, (size_t)size) : NULL;
    f->expects = *c != '\0';
    f->continues = *c && indented && !strpbrk(c, "=:");
    return feed_piece(f, buffer, (size_t)size);
}

static bool append(feed *f, const char *more) {
    ini_entry *const e = &f->document->entry[f->document->entries - 1];
    const size_t size = strlen(e->value) + strlen(more) + 2;
    char *const joined = malloc(size);
    if (!joined)
        return out_of_memory(f);
    snprintf(joined, size, "%s%s%s", e->value, f->joined ? "" : " ", more);
    free(e->value);
    e->value = joined;
    return true;
}

static bool add(feed *f, const char *section, const char *name, const char *value) {
    ini_document *const d = f->document;
    const ini_entry *const before = ini_find(d, section, name);
    if (before) {
        f->result = fail_usage("%.200s:%d: %.60s stands in line %d already; allowed is once", d->path, d->lines, name,
                               before->line);
        return false;
    }
    if (d->entries >= LIST_MAX)
        return fail_at(f, "too many entries");
    ini_entry *const list = grow(d->entry, d->entries, sizeof *list);
    if (!list)
        return out_of_memory(f);
    d->entry = list;
    const ini_entry e = {strdup(section), strdup(name), strdup(value), d->lines};
    d->entry[d->entries++] = e;
    return (e.section && e.name && e.value) || out_of_memory(f);
}

/// The handler that libinih calls. @return 1: go on (the reader ends it after an error)
static int take(void *user, const char *section, const char *name, const char *value) {
    feed *const f = user;
    f->expects = false;
    if (f->result || !name || !value)
        return 1;
    if (f->continues && f->document->entries > 0)
        append(f, value);
    else if (*section == '\0')
        fail_at(f, "a value outside a section; allowed is a section before it, like [planet]");
    else
        add(f, section, name, value);
    return 1;
}

int ini_read(ini_document *document, FILE *stream, const char *path) {
    *document = (ini_document){.path = path};
    feed *const f = calloc(1, sizeof *f);
    if (!f)
        return fail_job("out of memory");
    f->document = document;
    f->stream = stream;
    const int got = ini_parse_stream(feed_line, f, take, f);
    if (f->expects)
        fail_at(f, "no value; allowed is name = value, [section] or a comment behind ; or #");
    if (got == -2)
        out_of_memory(f);
    const int result = f->result;
    free(f);
    if (result)
        ini_free(document);
    return result;
}

#else

int ini_read(ini_document *document, FILE *stream, const char *path) {
    (void)stream;
    *document = (ini_document){.path = path};
    return fail_job(
        "%.200s: this build of skyvert reads no atmosphere files: install the package libinih-dev and make it "
        "again",
        path);
}

#endif
