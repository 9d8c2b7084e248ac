// The text lines of candump -L [can-utils], read and written without stdio.
#include "skv_candump.h"

#include <string.h>

#define ERROR_BIT 0x20000000u // of eight digits: an error frame

// A place in a line.
typedef struct text {
    const char *at, *end;
    const char *reason; // why it is no line of candump; NULL: all well
} text;

static int fail(text *t, const char *reason) {
    if (!t->reason)
        t->reason = reason;
    return 0;
}

static int hex(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
                                  : -1;
}

static int here(const text *t, char c) {
    return t->at < t->end && *t->at == c;
}

static int expect(text *t, char c, const char *reason) {
    if (!here(t, c))
        return fail(t, reason);
    t->at++;
    return 1;
}

// Digits from here on; *n says how many. More than `most` is an error.
static uint64_t decimal(text *t, int most, int *n) {
    uint64_t value = 0;
    for (*n = 0; t->at < t->end && *t->at >= '0' && *t->at <= '9'; t->at++) {
        if (++*n > most) {
            fail(t, "too many digits");
            return 0;
        }
        value = 10 * value + (uint64_t)(*t->at - '0');
    }
    return value;
}

static int read_time(text *t, int64_t *time_ns) {
    int whole = 0, part = 0;
    uint64_t seconds = 0, fraction = 0;
    if (expect(t, '(', "a line begins with (seconds.fraction)"))
        seconds = decimal(t, 10, &whole);
    if (!t->reason && expect(t, '.', "the time is (seconds.fraction)"))
        fraction = decimal(t, 9, &part);
    if (!t->reason && (whole == 0 || (part != 6 && part != 9)))
        fail(t, "the time has six or nine digits behind the point");
    if (!t->reason && seconds > 9000000000u)
        fail(t, "the time is too late");
    if (t->reason || !expect(t, ')', "the time ends with )"))
        return 0;
    *time_ns = (int64_t)(seconds * 1000000000u + fraction * (part == 6 ? 1000u : 1u));
    return 1;
}

static int skip_blanks(text *t) {
    int n = 0;
    for (; here(t, ' ') || here(t, '\t'); t->at++)
        n++;
    return n;
}

static int read_interface(text *t, char name[16]) {
    size_t n = 0;
    if (!skip_blanks(t))
        return fail(t, "a blank behind the time");
    for (; t->at<t->end && * t->at> ' ' && *t->at < 127; t->at++) {
        if (n == 15)
            return fail(t, "an interface has at most 15 letters");
        name[n++] = *t->at;
    }
    name[n] = 0;
    if (n == 0 || !skip_blanks(t))
        return fail(t, "an interface and a blank before the frame");
    return 1;
}

static int read_id(text *t, skv_can_frame *frame) {
    uint32_t id = 0;
    int n = 0;
    for (; t->at < t->end && hex(*t->at) >= 0; t->at++, n++) {
        if (n == 8)
            return fail(t, "an id has three or eight digits");
        id = id << 4 | (uint32_t)hex(*t->at);
    }
    if (n != 3 && n != 8)
        return fail(t, "an id has three or eight digits");
    if (n == 3 ? id > 0x7FFu : id > 0x3FFFFFFFu)
        return fail(t, n == 3 ? "an id of three digits is at most 7FF" : "an id is at most 1FFFFFFF");
    frame->flags = n == 3 ? 0 : id & ERROR_BIT ? SKV_CAN_ERROR : SKV_CAN_EXTENDED;
    frame->id = id & ~ERROR_BIT;
    return 1;
}

static int read_remote(text *t, skv_can_frame *frame) {
    if (frame->flags & SKV_CAN_ERROR)
        return fail(t, "an error frame is no remote request");
    t->at++;
    frame->flags |= SKV_CAN_RTR;
    if (t->at < t->end && *t->at >= '0' && *t->at <= '8')
        frame->length = (uint8_t)(*t->at++ - '0');
    return 1;
}

static int read_data(text *t, skv_can_frame *frame) {
    if (here(t, 'R') || here(t, 'r'))
        return read_remote(t, frame);
    int n = 0;
    for (; t->at < t->end && hex(*t->at) >= 0; t->at++, n++) {
        if (n == 16)
            return fail(t, "at most 8 bytes of data");
        frame->data[n / 2] = (uint8_t)(frame->data[n / 2] << 4 | hex(*t->at));
    }
    if (n % 2)
        return fail(t, "half a byte of data");
    frame->length = (uint8_t)(n / 2);
    if (n == 16 && here(t, '_')) { // a length code above 8
        t->at++;
        if (t->at == t->end || hex(*t->at) < 9)
            return fail(t, "a length code is 9 to F");
        t->at++;
    }
    return 1;
}

static int read_end(text *t) {
    const int blank = skip_blanks(t);
    if (blank && (here(t, 'T') || here(t, 'R')))
        t->at++;
    skip_blanks(t);
    return t->at == t->end ? 1 : fail(t, "letters behind the frame");
}

static skv_candump_result read_line(text *t, skv_candump_entry *entry) {
    memset(entry, 0, sizeof *entry);
    if (!read_time(t, &entry->time_ns) || !read_interface(t, entry->interface) || !read_id(t, &entry->frame) ||
        !expect(t, '#', "# between id and data"))
        return SKV_CANDUMP_ERROR;
    if (here(t, '#'))
        return SKV_CANDUMP_FD;
    return read_data(t, &entry->frame) && read_end(t) ? SKV_CANDUMP_FRAME : SKV_CANDUMP_ERROR;
}

skv_candump_result skv_candump_read(skv_candump_reader *reader, const char *line, size_t length,
                                    skv_candump_entry *entry) {
    if (!reader || !line || !entry)
        return SKV_CANDUMP_ERROR;
    reader->line++;
    reader->reason = NULL;
    reader->column = 0;
    if (length > 0 && line[length - 1] == '\n')
        length--;
    if (length > 0 && line[length - 1] == '\r')
        length--;
    if (length == 0)
        return SKV_CANDUMP_EMPTY;
    text t = {line, line + length, NULL};
    skv_candump_entry read;
    const skv_candump_result result = read_line(&t, &read);
    if (result == SKV_CANDUMP_ERROR) {
        reader->reason = t.reason;
        reader->column = (int)(t.at - line) + 1;
    } else if (result == SKV_CANDUMP_FD) {
        reader->fd_skipped++;
    } else {
        reader->backwards += reader->frames > 0 && read.time_ns < reader->last_ns;
        reader->last_ns = read.time_ns;
        reader->frames++;
        *entry = read;
    }
    return result;
}

// ------------------------------------------------------------------------------------------------------- writing

static char *put_hex(char *to, uint32_t value, int digits) {
    for (int i = digits - 1; i >= 0; i--)
        *to++ = "0123456789ABCDEF"[value >> 4 * i & 15u];
    return to;
}

static char *put_decimal(char *to, uint64_t value, int least_digits) {
    char digits[20];
    int n = 0;
    for (; value || n < least_digits; value /= 10)
        digits[n++] = (char)('0' + value % 10);
    while (n > 0)
        *to++ = digits[--n];
    return to;
}

static int is_frame(const skv_can_frame *f) {
    const uint32_t most = f->flags & (SKV_CAN_EXTENDED | SKV_CAN_ERROR) ? 0x1FFFFFFFu : 0x7FFu;
    return f->length <= 8 && f->id <= most && f->flags <= (SKV_CAN_EXTENDED | SKV_CAN_RTR | SKV_CAN_ERROR) &&
           (!(f->flags & SKV_CAN_ERROR) || f->flags == SKV_CAN_ERROR);
}

static char *put_frame(char *to, const skv_can_frame *frame) {
    const uint32_t error = frame->flags & SKV_CAN_ERROR ? ERROR_BIT : 0;
    to = put_hex(to, frame->id | error, frame->flags & (SKV_CAN_EXTENDED | SKV_CAN_ERROR) ? 8 : 3);
    *to++ = '#';
    if (frame->flags & SKV_CAN_RTR) {
        *to++ = 'R';
        if (frame->length)
            *to++ = (char)('0' + frame->length);
        return to;
    }
    for (int i = 0; i < frame->length; i++)
        to = put_hex(to, frame->data[i], 2);
    return to;
}

// Letters of a name; 0 or 16 = it is none.
static size_t name_length(const char name[16]) {
    size_t n = 0;
    while (n < 16 && name[n] > ' ' && name[n] < 127)
        n++;
    return n < 16 && name[n] ? 0 : n;
}

int skv_candump_write(char *line, size_t size, const skv_candump_entry *entry) {
    if (!line || !entry)
        return SKV_ERR_NULL;
    const size_t name = name_length(entry->interface);
    if (entry->time_ns < 0 || name == 0 || name == 16 || !is_frame(&entry->frame))
        return SKV_ERR_RANGE;
    char text_of[SKV_CANDUMP_LINE], *to = text_of;
    *to++ = '(';
    to = put_decimal(to, (uint64_t)entry->time_ns / 1000000000u, 1);
    *to++ = '.';
    to = put_decimal(to, (uint64_t)entry->time_ns % 1000000000u / 1000u, 6);
    *to++ = ')';
    *to++ = ' ';
    memcpy(to, entry->interface, name);
    to += name;
    *to++ = ' ';
    to = put_frame(to, &entry->frame);
    *to++ = '\n';
    const size_t length = (size_t)(to - text_of);
    if (length + 1 > size)
        return SKV_ERR_SIZE;
    memcpy(line, text_of, length);
    line[length] = 0;
    return (int)length;
}
