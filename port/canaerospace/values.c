// What a receiver knows.
#include "skv_canaerospace.h"

#include <string.h>

static const skv_cas_slot *slot_of(const skv_cas_receiver *receiver, skv_cas_index index, int number) {
    if (!receiver || (unsigned)index >= SKV_CAS_MESSAGES)
        return 0;
    return number == (skv_cas_table[index].low < skv_cas_table[index].high) ? &receiver->slot[index] : 0;
}

skv_cas_age skv_cas_value(const skv_cas_receiver *receiver, skv_cas_index index, double *value) {
    const skv_cas_slot *slot = slot_of(receiver, index, 1);
    if (!slot || !value)
        return SKV_CAS_NEVER;
    if (slot->age != SKV_CAS_NEVER)
        *value = slot->value;
    return (skv_cas_age)slot->age;
}

skv_cas_age skv_cas_bytes(const skv_cas_receiver *receiver, skv_cas_index index, uint8_t bytes[4]) {
    const skv_cas_slot *slot = slot_of(receiver, index, 0);
    if (!slot || !bytes)
        return SKV_CAS_NEVER;
    if (slot->age != SKV_CAS_NEVER)
        memcpy(bytes, slot->bytes, 4);
    return (skv_cas_age)slot->age;
}

skv_cas_datum skv_cas_height(const skv_cas_receiver *receiver, double *height_m) {
    static const uint8_t best[] = {SKV_CAS_GPS_HEIGHT, SKV_CAS_TRUE_ALTITUDE, SKV_CAS_BARO_ALTITUDE,
                                   SKV_CAS_STANDARD_ALTITUDE};
    for (unsigned i = 0; receiver && height_m && i < sizeof best; i++)
        if (receiver->slot[best[i]].age == SKV_CAS_FRESH) {
            *height_m = receiver->slot[best[i]].value;
            return (skv_cas_datum)skv_cas_table[best[i]].datum;
        }
    return SKV_CAS_NO_HEIGHT;
}
