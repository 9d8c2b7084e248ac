// Node services: identification (0), which every node owes, and synchronisation (1).
#include "skv_canaerospace.h"

#include <string.h>

// A message of channel 0, if the frame is one of this service and type.
static int is_service(const skv_can_frame *frame, uint32_t id, uint8_t service, uint8_t type,
                      skv_cas_message *message) {
    return frame && frame->id == id && skv_cas_unpack(message, frame) == SKV_OK && message->service == service &&
           message->type == type;
}

skv_status skv_cas_identification_request(skv_can_frame *frame, uint8_t node, uint8_t code) {
    const skv_cas_message message = {.node = node, .type = SKV_CAS_NODATA, .code = code};
    return skv_cas_pack(frame, SKV_CAS_ID_REQUEST, &message);
}

int skv_cas_identify(const skv_can_frame *frame, const skv_cas_identity *self, skv_can_frame *reply) {
    skv_cas_message message;
    if (!self || !reply || !is_service(frame, SKV_CAS_ID_REQUEST, 0, SKV_CAS_NODATA, &message))
        return 0;
    if (message.node != 0 && message.node != self->node)
        return 0;
    message.node = self->node;
    message.type = SKV_CAS_UCHAR4;
    message.data.u[0] = self->hardware_revision;
    message.data.u[1] = self->software_revision;
    message.data.u[2] = message.data.u[3] = 0;
    return skv_cas_pack(reply, SKV_CAS_ID_REPLY, &message) == SKV_OK;
}

int skv_cas_identified(const skv_can_frame *frame, skv_cas_identity *who) {
    skv_cas_message message;
    if (!who || !is_service(frame, SKV_CAS_ID_REPLY, 0, SKV_CAS_UCHAR4, &message))
        return 0;
    *who = (skv_cas_identity){message.node, message.data.u[0], message.data.u[1]};
    return 1;
}

int skv_cas_time_sync(const skv_can_frame *frame, uint32_t *stamp) {
    skv_cas_message message;
    if (!stamp || !is_service(frame, SKV_CAS_ID_REQUEST, 1, SKV_CAS_ULONG, &message))
        return 0;
    *stamp = message.data.ul;
    return 1;
}

skv_status skv_cas_time_sync_request(skv_can_frame *frame, uint32_t stamp) {
    skv_cas_message message = {.type = SKV_CAS_ULONG, .service = 1};
    message.data.ul = stamp;
    return skv_cas_pack(frame, SKV_CAS_ID_REQUEST, &message);
}
