// The sender's side: values to frames, message codes counted.
#include "skv_canaerospace.h"

#include <string.h>

// Angles farther out than this are somebody's error, not a turn.
#define TURN_LIMIT 1e6

// Brings an angle into (-180, 180] or [0, 360).
static double wrapped(double deg, uint8_t wraps) {
    const double turns = (double)(int32_t)(deg / 360.0);
    deg -= 360.0 * turns;
    if (wraps == 1)
        return deg > 180.0 ? deg - 360.0 : deg <= -180.0 ? deg + 360.0 : deg;
    return deg < 0.0 ? deg + 360.0 : deg;
}

// The data of one frame; a double's halves are written by its caller.
static void set_number(skv_cas_message *message, const skv_cas_info *info, double value) {
    if (message->type == SKV_CAS_LONG) {
        const double counts = value * (double)info->per_unit;
        message->data.l = (int32_t)(counts < 0.0 ? counts - 0.5 : counts + 0.5);
    } else {
        message->data.f = (float)value;
        if (info->wraps == 2 && message->data.f >= 360.0f) // 359.999999 as float is 360
            message->data.f = 0.0f;
    }
}

static int encode_double(skv_cas_sender *sender, skv_cas_index index, skv_cas_message *message, double value,
                         skv_can_frame frames[2]) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 2; i++) {
        message->data.ul = message->type == SKV_CAS_DOUBLEH ? (uint32_t)(bits >> 32) : (uint32_t)(bits & 0xFFFFFFFFu);
        (void)skv_cas_pack(&frames[i], skv_cas_table[index].id, message);
        message->code = (uint8_t)(message->code + 1);
        message->type = message->type == SKV_CAS_DOUBLEH ? SKV_CAS_DOUBLEL : SKV_CAS_DOUBLEH;
    }
    sender->next[index] = message->code;
    return 2;
}

int skv_cas_encode(skv_cas_sender *sender, skv_cas_index index, uint8_t type, double value, skv_can_frame frames[2]) {
    if (!sender || !frames)
        return SKV_ERR_NULL;
    if ((unsigned)index >= SKV_CAS_MESSAGES)
        return SKV_ERR_RANGE;
    const skv_cas_info *info = &skv_cas_table[index];
    if (info->low >= info->high) // bytes
        return SKV_ERR_RANGE;
    if (type == 0)
        type = info->type;
    if (type > 31 || !(info->types >> type & 1u))
        return SKV_ERR_UNSUPPORTED;
    if (info->wraps && value >= -TURN_LIMIT && value <= TURN_LIMIT)
        value = wrapped(value, info->wraps);
    if (!(value >= (double)info->low && value <= (double)info->high))
        return SKV_ERR_RANGE;
    skv_cas_message message = {.node = sender->node, .type = type, .code = sender->next[index]};
    if (type == SKV_CAS_DOUBLEH || type == SKV_CAS_DOUBLEL)
        return encode_double(sender, index, &message, value, frames);
    set_number(&message, info, value);
    (void)skv_cas_pack(&frames[0], info->id, &message);
    sender->next[index] = (uint8_t)(message.code + 1);
    return 1;
}

int skv_cas_encode_bytes(skv_cas_sender *sender, skv_cas_index index, const uint8_t bytes[4], skv_can_frame *frame) {
    if (!sender || !bytes || !frame)
        return SKV_ERR_NULL;
    if ((unsigned)index >= SKV_CAS_MESSAGES || !skv_cas_bytes_valid(index, bytes))
        return SKV_ERR_RANGE;
    skv_cas_message message = {.node = sender->node, .type = skv_cas_table[index].type, .code = sender->next[index]};
    memcpy(message.data.u, bytes, 4);
    (void)skv_cas_pack(frame, skv_cas_table[index].id, &message);
    sender->next[index] = (uint8_t)(message.code + 1);
    return 1;
}
