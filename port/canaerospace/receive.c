// The receiver: judges every frame, counts, and keeps the values that passed.
#include "skv_canaerospace.h"

#include <string.h>

#define NS_PER_MS 1000000

// Flags of a slot.
enum {
    LOCKED = 1,  // node and code are known
    ODD = 2,     // the last frame looked old: odd_code is its code
    WAITING = 4, // a half waits
    ORDERED = 8, // the order of the halves is known:
    LOWER_FIRST = 16,
    DOUBTED = 32, // a pair came in the other order once
};

static void add_to(uint32_t *count, uint32_t by) {
    *count = by > UINT32_MAX - *count ? UINT32_MAX : *count + by;
}

static void count(skv_cas_receiver *r, skv_cas_slot *slot, skv_cas_count what, uint32_t by) {
    add_to(&r->total[what], by);
    if (slot)
        add_to(&slot->count[what], by);
}

void skv_cas_clear(skv_cas_receiver *receiver) {
    if (receiver)
        memset(receiver, 0, sizeof *receiver);
}

// A clock that ran backwards must not keep a dead value fresh: its age begins anew.
static void age_slot(skv_cas_receiver *r, int index, int64_t now_ns) {
    skv_cas_slot *slot = &r->slot[index];
    if (slot->age != SKV_CAS_FRESH)
        return;
    if (now_ns < slot->time_ns)
        slot->time_ns = now_ns;
    if (now_ns - slot->time_ns > (int64_t)3 * NS_PER_MS * skv_cas_table[index].period_ms) {
        slot->age = SKV_CAS_OLD;
        count(r, slot, SKV_CAS_STALE, 1);
    }
}

int skv_cas_tick(skv_cas_receiver *receiver, int64_t now_ns) {
    int stale = 0;
    for (int i = 0; receiver && i < SKV_CAS_MESSAGES; i++) {
        age_slot(receiver, i, now_ns);
        stale += receiver->slot[i].age == SKV_CAS_OLD;
    }
    return stale;
}

// The code of a frame of the slot's own node. Ahead by less than half of the circle: frames are missing. Behind: old,
// or the sender began anew, which its next frame shows.
static skv_cas_count judge_code(skv_cas_receiver *r, skv_cas_slot *slot, uint8_t code) {
    const unsigned step = (uint8_t)(code - slot->code);
    const int fresh = slot->age == SKV_CAS_FRESH;
    if (r->ignore_codes) {
        slot->code = code;
        return SKV_CAS_ACCEPTED;
    }
    if (fresh && step == 0)
        return SKV_CAS_DUPLICATE;
    if (step == 0 || step > 127) {
        const int goes_on = slot->flags & ODD && code == (uint8_t)(slot->odd_code + 1);
        if (fresh && !goes_on) {
            slot->flags |= ODD;
            slot->odd_code = code;
            return SKV_CAS_REORDERED;
        }
        count(r, slot, SKV_CAS_RESTART, 1);
        slot->flags &= LOCKED | WAITING;
    } else if (step > 1) {
        count(r, slot, SKV_CAS_MISSING, step - 1);
    }
    slot->flags &= (uint8_t)~ODD;
    slot->code = code;
    return SKV_CAS_ACCEPTED;
}

// Which node counts: the first one accepted, until it falls silent.
static skv_cas_count judge_node(skv_cas_receiver *r, skv_cas_slot *slot, const skv_cas_message *message) {
    if (!(slot->flags & LOCKED))
        return SKV_CAS_ACCEPTED;
    if (slot->node == message->node)
        return judge_code(r, slot, message->code);
    return slot->age == SKV_CAS_FRESH ? SKV_CAS_OTHER_NODE : SKV_CAS_ACCEPTED;
}

static void lock(skv_cas_receiver *r, skv_cas_slot *slot, const skv_cas_message *message) {
    if (slot->flags & LOCKED && slot->node != message->node) {
        count(r, slot, SKV_CAS_RESTART, 1);
        slot->flags &= WAITING;
    }
    slot->flags |= LOCKED;
    slot->node = message->node;
    slot->code = message->code;
}

static skv_cas_count accept_number(skv_cas_slot *slot, const skv_cas_info *info, double value) {
    if (!(value - value == 0.0)) // NaN and infinities
        return SKV_CAS_NOT_FINITE;
    if (info->wraps == 1 && value > 180.0 && value <= 360.0)
        value -= 360.0;
    if (info->wraps == 2 && value < 0.0 && value >= -180.0)
        value += 360.0;
    if (!(value >= (double)info->low && value <= (double)info->high))
        return SKV_CAS_OUT_OF_RANGE;
    slot->value = info->wraps == 2 && value >= 360.0 ? 0.0 : value;
    return SKV_CAS_ACCEPTED;
}

static void drop_half(skv_cas_receiver *r, skv_cas_slot *slot) {
    if (slot->flags & WAITING)
        count(r, slot, SKV_CAS_UNPAIRED, 1);
    slot->flags &= (uint8_t)~WAITING;
}

// Whether this half belongs to the one that waits: the other type, the next code, close in time, and the order that was
// seen before. (L of one number and H of the next differ in time and order only.) Two contradictions change the order.
static int pairs(skv_cas_receiver *r, skv_cas_slot *slot, const skv_cas_info *info, const skv_cas_message *message,
                 int64_t now_ns) {
    const int64_t gap = now_ns - slot->half_ns;
    if (!(slot->flags & WAITING) || slot->half_type == message->type || slot->node != message->node)
        return 0;
    if (!r->ignore_codes && message->code != (uint8_t)(slot->half_code + 1))
        return 0;
    if (gap < 0 || gap > (int64_t)NS_PER_MS * info->period_ms / 4)
        return 0;
    const uint8_t order = slot->half_type == SKV_CAS_DOUBLEL ? LOWER_FIRST : 0;
    if (slot->flags & ORDERED && (slot->flags & LOWER_FIRST) != order) {
        slot->flags = (uint8_t)(slot->flags & DOUBTED ? slot->flags & ~(ORDERED | DOUBTED) : slot->flags | DOUBTED);
        return 0;
    }
    slot->flags = (uint8_t)((slot->flags & ~(LOWER_FIRST | DOUBTED | WAITING)) | ORDERED | order);
    return 1;
}

static skv_cas_count take_half(skv_cas_receiver *r, skv_cas_slot *slot, const skv_cas_info *info,
                               const skv_cas_message *message, int64_t now_ns) {
    if (!pairs(r, slot, info, message, now_ns)) {
        drop_half(r, slot);
        slot->flags |= WAITING;
        slot->half = message->data.ul;
        slot->half_type = message->type;
        slot->half_code = message->code;
        slot->half_ns = now_ns;
        slot->node = message->node;
        return SKV_CAS_HALF;
    }
    const int upper = message->type == SKV_CAS_DOUBLEH;
    const uint64_t high = upper ? message->data.ul : slot->half, low = upper ? slot->half : message->data.ul;
    const uint64_t bits = high << 32 | low;
    double value;
    memcpy(&value, &bits, sizeof value);
    return accept_number(slot, info, value);
}

static skv_cas_count take_data(skv_cas_receiver *r, int index, const skv_cas_message *message, int64_t now_ns) {
    const skv_cas_info *info = &skv_cas_table[index];
    skv_cas_slot *slot = &r->slot[index];
    switch (message->type) {
    case SKV_CAS_DOUBLEH:
    case SKV_CAS_DOUBLEL:
        return take_half(r, slot, info, message, now_ns);
    case SKV_CAS_FLOAT:
        return accept_number(slot, info, (double)message->data.f);
    case SKV_CAS_LONG:
        return accept_number(slot, info, (double)message->data.l / (double)info->per_unit);
    default:
        if (!skv_cas_bytes_valid((skv_cas_index)index, message->data.u))
            return SKV_CAS_OUT_OF_RANGE;
        memcpy(slot->bytes, message->data.u, 4);
        return SKV_CAS_ACCEPTED;
    }
}

// Service code, type and length, in this order.
static skv_cas_count judge_header(const skv_can_frame *frame, uint32_t types, skv_cas_message *message) {
    if (frame->length < 4 || frame->length > 8)
        return SKV_CAS_BAD_LENGTH;
    if (frame->data[2] != 0)
        return SKV_CAS_BAD_SERVICE;
    if (frame->data[1] > 31 || !(types >> frame->data[1] & 1u))
        return SKV_CAS_BAD_TYPE;
    return skv_cas_unpack(message, frame) == SKV_OK ? SKV_CAS_ACCEPTED : SKV_CAS_BAD_LENGTH;
}

static skv_cas_count take(skv_cas_receiver *r, int index, const skv_can_frame *frame, int64_t now_ns) {
    skv_cas_slot *slot = &r->slot[index];
    skv_cas_message message;
    age_slot(r, index, now_ns);
    skv_cas_count verdict = judge_header(frame, skv_cas_table[index].types, &message);
    if (verdict == SKV_CAS_ACCEPTED)
        verdict = judge_node(r, slot, &message);
    if (verdict == SKV_CAS_ACCEPTED)
        verdict = take_data(r, index, &message, now_ns);
    if (verdict == SKV_CAS_ACCEPTED) {
        drop_half(r, slot);
        lock(r, slot, &message);
        slot->type = message.type;
        slot->time_ns = now_ns;
        slot->age = SKV_CAS_FRESH;
    }
    return verdict;
}

// Service codes 0 to 15 are the specification's, from 100 on they are the builder's.
static skv_cas_count judge_service(const skv_can_frame *frame) {
    if (frame->length < 4 || frame->length > 8)
        return SKV_CAS_BAD_LENGTH;
    const uint8_t type = frame->data[1], service = frame->data[2];
    if (service > 15 && service < 100)
        return SKV_CAS_BAD_SERVICE;
    if (frame->id == SKV_CAS_ID_REQUEST && service < 2 && type != (service ? SKV_CAS_ULONG : SKV_CAS_NODATA))
        return SKV_CAS_BAD_TYPE;
    return SKV_CAS_SERVICE;
}

static skv_cas_count judge(skv_cas_receiver *r, int index, const skv_can_frame *frame, int64_t now_ns) {
    if (frame->flags & SKV_CAN_ERROR)
        return SKV_CAS_BUS_ERROR;
    if (frame->flags || frame->id > 0x7FFu)
        return SKV_CAS_BAD_FORMAT;
    if (index >= 0)
        return take(r, index, frame, now_ns);
    // Node services of high and low priority.
    if ((frame->id >= 128 && frame->id <= 199) || (frame->id >= 2000 && frame->id <= 2031))
        return judge_service(frame);
    return SKV_CAS_UNKNOWN;
}

skv_cas_count skv_cas_receive(skv_cas_receiver *receiver, const skv_can_frame *frame, int64_t now_ns) {
    if (!receiver || !frame)
        return SKV_CAS_UNKNOWN;
    const int index = frame->flags & (SKV_CAN_ERROR | SKV_CAN_EXTENDED) ? -1 : skv_cas_find(frame->id);
    const skv_cas_count verdict = judge(receiver, index, frame, now_ns);
    count(receiver, index < 0 ? NULL : &receiver->slot[index], verdict, 1);
    return verdict;
}
