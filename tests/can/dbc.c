// Writes port/canaerospace/skyvert.dbc from the table of messages (make dbc), and the README's table (--readme).
#include <stdio.h>
#include <string.h>

#include "port/canaerospace/skv_canaerospace.h"

static const struct {
    uint8_t type;
    const char *name;
} types[] = {
    {SKV_CAS_NODATA, "NODATA"}, {SKV_CAS_FLOAT, "FLOAT"},     {SKV_CAS_LONG, "LONG"},       {SKV_CAS_ULONG, "ULONG"},
    {SKV_CAS_SHORT, "SHORT"},   {SKV_CAS_UCHAR, "UCHAR"},     {SKV_CAS_SHORT2, "SHORT2"},   {SKV_CAS_CHAR4, "CHAR4"},
    {SKV_CAS_UCHAR4, "UCHAR4"}, {SKV_CAS_DOUBLEH, "DOUBLEH"}, {SKV_CAS_DOUBLEL, "DOUBLEL"},
};
#define TYPES (int)(sizeof types / sizeof types[0])

// The four bytes of the messages that are no numbers.
static const struct {
    int index;
    const char *byte[4];
    int high[4];
} bytes[] = {
    {SKV_CAS_UTC, {"Hour", "Minute", "Second", NULL}, {23, 59, 60, 0}},
    {SKV_CAS_DATE, {"Day", "Month", "Century", "YearOfCentury"}, {31, 12, 21, 99}},
    {SKV_CAS_SKY_STATE, {"State", "Lamps", "StaleValues", NULL}, {4, 3, SKV_CAS_MESSAGES, 0}},
};

static void print_head(void) {
    printf("VERSION \"\"\n\n\nNS_ :\n\nBS_:\n\nBU_: Skyvert\n\n\n");
}

// Bits of a DBC are named by the place of the first one: the highest bit of byte n is 8 n + 7.
static void print_header_signals(void) {
    printf(" SG_ NodeId : 7|8@0+ (1,0) [0|255] \"\" Vector__XXX\n"
           " SG_ DataType M : 15|8@0+ (1,0) [0|255] \"\" Vector__XXX\n"
           " SG_ ServiceCode : 23|8@0+ (1,0) [0|255] \"\" Vector__XXX\n"
           " SG_ MessageCode : 31|8@0+ (1,0) [0|255] \"\" Vector__XXX\n");
}

// The name of a number's signal: FLOAT has the message's own.
static const char *signal_name(const skv_cas_info *info, int type) {
    static char name[64];
    snprintf(name, sizeof name, "%s%s%s", info->name, types[type].type == SKV_CAS_FLOAT ? "" : "_",
             types[type].type == SKV_CAS_FLOAT ? "" : types[type].name);
    return name;
}

static void print_number(const skv_cas_info *info, int type) {
    const char *name = signal_name(info, type);
    switch (types[type].type) {
    case SKV_CAS_FLOAT:
        printf(" SG_ %s m2 : 39|32@0- (1,0) [%.9g|%.9g] \"%s\" Vector__XXX\n", name, (double)info->low,
               (double)info->high, info->unit);
        break;
    case SKV_CAS_LONG:
        printf(" SG_ %s m3 : 39|32@0- (%.9g,0) [%.9g|%.9g] \"%s\" Vector__XXX\n", name, 1.0 / (double)info->per_unit,
               (double)info->low, (double)info->high, info->unit);
        break;
    default: // half of a double
        printf(" SG_ %s m%d : 39|32@0+ (1,0) [0|4294967295] \"\" Vector__XXX\n", name, types[type].type);
    }
}

static void print_bytes(int index, int type) {
    for (size_t i = 0; i < sizeof bytes / sizeof bytes[0]; i++)
        for (int b = 0; b < 4 && bytes[i].index == index; b++)
            if (bytes[i].byte[b])
                printf(" SG_ %s%s%s m%d : %d|8@0+ (1,0) [0|%d] \"\" Vector__XXX\n", skv_cas_table[index].name,
                       bytes[i].byte[b], types[type].type == skv_cas_table[index].type ? "" : "_UCHAR4",
                       types[type].type, 39 + 8 * b, bytes[i].high[b]);
}

static void print_message(int index) {
    const skv_cas_info *info = &skv_cas_table[index];
    printf("BO_ %d %s: 8 Skyvert\n", info->id, info->name);
    print_header_signals();
    for (int t = 0; t < TYPES; t++) {
        if (!(info->types >> types[t].type & 1u))
            continue;
        if (info->low < info->high)
            print_number(info, t);
        else
            print_bytes(index, t);
    }
    printf("\n");
}

static void print_services(void) {
    printf("BO_ %u NodeServiceRequest: 8 Skyvert\n", SKV_CAS_ID_REQUEST);
    print_header_signals();
    printf(" SG_ TimeStamp m4 : 39|32@0+ (1,0) [0|4294967295] \"\" Vector__XXX\n\n");
    printf("BO_ %u NodeServiceReply: 8 Skyvert\n", SKV_CAS_ID_REPLY);
    print_header_signals();
    printf(" SG_ HardwareRevision m16 : 39|8@0+ (1,0) [0|255] \"\" Vector__XXX\n"
           " SG_ SoftwareRevision m16 : 47|8@0+ (1,0) [0|255] \"\" Vector__XXX\n"
           " SG_ IdDistribution m16 : 55|8@0+ (1,0) [0|255] \"\" Vector__XXX\n"
           " SG_ HeaderType m16 : 63|8@0+ (1,0) [0|255] \"\" Vector__XXX\n\n");
}

static const char *meant(int index) {
    switch (skv_cas_table[index].datum) {
    case SKV_CAS_ELLIPSOID:
        return "above the ellipsoid (WGS84)";
    case SKV_CAS_SEA:
        return index == SKV_CAS_BARO_ALTITUDE ? "above the sea, by pressure" : "above the sea";
    case SKV_CAS_PRESSURE:
        return "pressure altitude at 1013.25 hPa";
    case SKV_CAS_GROUND:
        return "above the ground";
    default:
        return NULL;
    }
}

static void print_comments(void) {
    printf("CM_ \"CANaerospace 1.7 as Skyvert speaks it. Written from the table of messages by tests/can/dbc.c (make "
           "dbc): do "
           "not edit. Not said here, for a DBC cannot: 1. Latitude_DOUBLEH and _DOUBLEL, Longitude_DOUBLEH and "
           "_DOUBLEL are "
           "the two halves of one IEEE double, upper and lower, in two frames that follow each other in either order. "
           "2. The "
           "message code goes up by one with every frame of an id and wraps at 255. 3. A frame is as long as its type: "
           "4 bytes "
           "and the data. 4. CHAR4 bytes are signed in the specification; here all are within 0 to 127.\";\n");
    for (int i = 0; i < SKV_CAS_MESSAGES; i++)
        if (meant(i))
            printf("CM_ BO_ %d \"%s\";\n", skv_cas_table[i].id, meant(i));
}

static void print_attributes(void) {
    printf("BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 65535;\nBA_DEF_DEF_ \"GenMsgCycleTime\" 0;\n");
    for (int i = 0; i < SKV_CAS_MESSAGES; i++)
        printf("BA_ \"GenMsgCycleTime\" BO_ %d %d;\n", skv_cas_table[i].id, skv_cas_table[i].period_ms);
}

static void print_names(unsigned id) {
    printf("VAL_ %u DataType", id);
    for (int t = 0; t < TYPES; t++)
        printf(" %d \"%s\"", types[t].type, types[t].name);
    printf(" ;\n");
}

static void print_values(void) {
    print_names(SKV_CAS_ID_REQUEST);
    print_names(SKV_CAS_ID_REPLY);
    for (int i = 0; i < SKV_CAS_MESSAGES; i++)
        print_names(skv_cas_table[i].id);
    printf("VAL_ %d SkyStateState 0 \"day\" 1 \"civil twilight\" 2 \"nautical twilight\" 3 \"astronomical twilight\" 4 "
           "\"night\" ;\n",
           skv_cas_table[SKV_CAS_SKY_STATE].id);
    for (int i = 0; i < SKV_CAS_MESSAGES; i++)
        if (skv_cas_table[i].types >> SKV_CAS_FLOAT & 1u)
            printf("SIG_VALTYPE_ %d %s : 1;\n", skv_cas_table[i].id, skv_cas_table[i].name);
}

static void print_readme(void) {
    printf("| id | message | types | unit | from, to | every |\n|---|---|---|---|---|---|\n");
    for (int i = 0; i < SKV_CAS_MESSAGES; i++) {
        const skv_cas_info *info = &skv_cas_table[i];
        const char *comma = "";
        printf("| %d | %s | ", info->id, info->name);
        for (int t = 0; t < TYPES; t++)
            if (info->types >> types[t].type & 1u && types[t].type != SKV_CAS_DOUBLEL) {
                printf("%s%s", comma, types[t].type == SKV_CAS_DOUBLEH ? "DOUBLEH + DOUBLEL" : types[t].name);
                comma = ", ";
            }
        if (info->low < info->high)
            printf(" | %s%s%s | %.9g, %.9g | %d ms |\n", info->unit, meant(i) ? " " : "", meant(i) ? meant(i) : "",
                   (double)info->low, (double)info->high, info->period_ms);
        else
            printf(" | four bytes | | %d ms |\n", info->period_ms);
    }
}

int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], "--readme") == 0) {
        print_readme();
        return 0;
    }
    print_head();
    print_services();
    for (int i = 0; i < SKV_CAS_MESSAGES; i++)
        print_message(i);
    print_comments();
    print_attributes();
    print_values();
    return 0;
}
