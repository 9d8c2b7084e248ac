/// An ini file as libinih reads it, with the line of everything.
#ifndef SKYVERT_INI_DOCUMENT_H
#define SKYVERT_INI_DOCUMENT_H

#include <stddef.h>
#include <stdio.h>

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

#endif
