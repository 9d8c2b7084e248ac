/// An ini file as libinih reads it, with the line of everything.
#ifndef SKYVERT_INI_DOCUMENT_H
#define SKYVERT_INI_DOCUMENT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "command.h"

typedef struct ini_entry {
    char *section, *name, *value;
    int line;
} ini_entry;

typedef struct ini_section {
    char *name;
    int line;
} ini_section;

typedef struct ini_document {
    const char *path;
    ini_entry *entry;
    size_t entries;
    ini_section *section;
    size_t sections;
    int lines;
} ini_document;

/// Grammar: [section], name = value (or name: value), comments from ; or # at the start of a line and from " ;" within
/// it, blank lines, CRLF, a byte order mark; an indented line without = continues the value before it.
/// @param[in] path  for messages; kept by reference.
/// @return 0; 2 after one error line (nothing has to be freed then); 1 iff memory ran out or this build lacks libinih.
int ini_read(ini_document *document, FILE *stream, const char *path);
void ini_free(ini_document *document);

const ini_section *ini_find_section(const ini_document *document, const char *name);
const ini_entry *ini_find(const ini_document *document, const char *section, const char *name);

/// Takes what a document means; the first error ends it.
typedef struct ini_taker {
    const ini_document *document;
    int result; ///< 0, or the exit status after the error line; nothing more is read then
} ini_taker;

/// A section and its keys, NULL behind the last.
typedef struct ini_known {
    const char *section;
    const char *keys[13];
} ini_known;

/// An error line `file:line: ...`, if it is the first.
void ini_fail(ini_taker *r, int line, const char *format, ...) SKV_PRINTF(3, 4);
/// Names of sections and keys: all must be among these n.
void ini_check_names(ini_taker *r, const ini_known *known, int n);
/// @return NULL where there is none, after an error line if it is needed
const ini_entry *ini_want(ini_taker *r, const char *section, const char *key, bool needed);

/// Path of a file that is named as seen from the document's folder; to be freed. @return NULL iff memory ran out
char *ini_beside(const ini_document *document, const char *name);

#endif
