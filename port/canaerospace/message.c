// Frames to their parts and back: big-endian, by shifts, so that it is right on any machine.
#include "skv_canaerospace.h"

#include <string.h>

int skv_cas_type_size(uint8_t type) {
    switch (type) {
    case SKV_CAS_NODATA:
        return 0;
    case SKV_CAS_UCHAR:
        return 1;
    case SKV_CAS_SHORT:
        return 2;
    case SKV_CAS_FLOAT:
    case SKV_CAS_LONG:
    case SKV_CAS_ULONG:
    case SKV_CAS_SHORT2:
    case SKV_CAS_CHAR4:
    case SKV_CAS_UCHAR4:
    case SKV_CAS_DOUBLEH:
    case SKV_CAS_DOUBLEL:
        return 4;
    default:
        return -1;
    }
}

static void put_word(uint8_t *to, uint32_t word) {
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(word >> (24 - 8 * i));
}

static uint32_t get_word(const uint8_t *from) {
    return (uint32_t)from[0] << 24 | (uint32_t)from[1] << 16 | (uint32_t)from[2] << 8 | from[3];
}

// The 32 bits of a float or of an int32_t, which is two's complement wherever there is one.
static uint32_t bits_of(const void *from) {
    uint32_t bits;
    memcpy(&bits, from, sizeof bits);
    return bits;
}

static void put_data(uint8_t *to, const skv_cas_message *message) {
    switch (message->type) {
    case SKV_CAS_FLOAT:
        put_word(to, bits_of(&message->data.f));
        break;
    case SKV_CAS_LONG:
        put_word(to, bits_of(&message->data.l));
        break;
    case SKV_CAS_SHORT:
    case SKV_CAS_SHORT2:
        for (int i = 0; i < (message->type == SKV_CAS_SHORT ? 1 : 2); i++) {
            to[2 * i] = (uint8_t)((uint16_t)message->data.s[i] >> 8);
            to[2 * i + 1] = (uint8_t)((uint16_t)message->data.s[i] & 255u);
        }
        break;
    case SKV_CAS_UCHAR:
        to[0] = message->data.u[0];
        break;
    case SKV_CAS_CHAR4:
    case SKV_CAS_UCHAR4:
        memcpy(to, message->data.u, 4);
        break;
    case SKV_CAS_NODATA:
        break;
    default: // ULONG, DOUBLEH, DOUBLEL
        put_word(to, message->data.ul);
    }
}

static int16_t get_short(const uint8_t *from) {
    const uint16_t bits = (uint16_t)((unsigned)from[0] << 8 | from[1]);
    int16_t value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void get_data(skv_cas_message *message, const uint8_t *from) {
    const uint32_t word = get_word(from);
    switch (message->type) {
    case SKV_CAS_FLOAT:
        memcpy(&message->data.f, &word, sizeof word);
        break;
    case SKV_CAS_LONG:
        memcpy(&message->data.l, &word, sizeof word);
        break;
    case SKV_CAS_SHORT:
    case SKV_CAS_SHORT2:
        message->data.s[0] = get_short(from);
        message->data.s[1] = message->type == SKV_CAS_SHORT2 ? get_short(from + 2) : (int16_t)0;
        break;
    case SKV_CAS_UCHAR:
        message->data.ul = 0;
        message->data.u[0] = from[0];
        break;
    case SKV_CAS_CHAR4:
    case SKV_CAS_UCHAR4:
        memcpy(message->data.u, from, 4);
        break;
    case SKV_CAS_NODATA:
        message->data.ul = 0;
        break;
    default:
        message->data.ul = word;
    }
}

skv_status skv_cas_pack(skv_can_frame *frame, uint32_t id, const skv_cas_message *message) {
    if (!frame || !message)
        return SKV_ERR_NULL;
    if (id > 0x7FFu)
        return SKV_ERR_RANGE;
    const int size = skv_cas_type_size(message->type);
    if (size < 0)
        return SKV_ERR_UNSUPPORTED;
    memset(frame, 0, sizeof *frame);
    frame->id = id;
    frame->length = (uint8_t)(4 + size);
    frame->data[0] = message->node;
    frame->data[1] = message->type;
    frame->data[2] = message->service;
    frame->data[3] = message->code;
    put_data(frame->data + 4, message);
    return SKV_OK;
}

skv_status skv_cas_unpack(skv_cas_message *message, const skv_can_frame *frame) {
    if (!frame || !message)
        return SKV_ERR_NULL;
    if (frame->flags || frame->id > 0x7FFu || frame->length < 4 || frame->length > 8)
        return SKV_ERR_RANGE;
    const int size = skv_cas_type_size(frame->data[1]);
    if (size < 0)
        return SKV_ERR_UNSUPPORTED;
    if (frame->length != 4 + size && frame->length != 8)
        return SKV_ERR_RANGE;
    message->node = frame->data[0];
    message->type = frame->data[1];
    message->service = frame->data[2];
    message->code = frame->data[3];
    get_data(message, frame->data + 4);
    return SKV_OK;
}

// Start of frame to CRC is stuffed: at worst a bit after the first five and then after every four. Then come
// delimiters, acknowledge, end of frame (10 bits) and the space of 3 bits.
int skv_cas_frame_bits(const skv_can_frame *frame) {
    if (!frame)
        return 0;
    const int data = frame->flags & SKV_CAN_RTR ? 0 : 8 * (frame->length > 8 ? 8 : frame->length);
    const int stuffed = (frame->flags & SKV_CAN_EXTENDED ? 54 : 34) + data;
    return stuffed + (stuffed - 1) / 4 + 13;
}
