// The table of messages. Ids, units and periods below 1800: [CANaerospace] section 5; the rest is this project's own.
#include "skv_canaerospace.h"

#define T(type)    (1ul << (type))
#define F          T(SKV_CAS_FLOAT)
#define POSITION   (F | T(SKV_CAS_LONG) | T(SKV_CAS_DOUBLEH) | T(SKV_CAS_DOUBLEL))
#define FOUR_BYTES (T(SKV_CAS_CHAR4) | T(SKV_CAS_UCHAR4))
#define NUMBER(id, ms, low, high, datum, wraps, name, unit)                                                            \
    { id, ms, F, low, high, 1.0f, SKV_CAS_FLOAT, datum, wraps, name, unit }
#define BYTES(id, types, type, name)                                                                                   \
    { id, 1000, types, 0.0f, 0.0f, 1.0f, type, SKV_CAS_NO_HEIGHT, 0, name, "" }

// Heights go from below the Dead Sea to geostationary orbit. Aerodynamic limits are not set: simulators fly anything.
const skv_cas_info skv_cas_table[SKV_CAS_MESSAGES] = {
    NUMBER(311, 100, -180.0f, 180.0f, 0, 0, "BodyPitchAngle", "deg"),
    NUMBER(312, 100, -180.0f, 180.0f, 0, 0, "BodyRollAngle", "deg"),
    NUMBER(314, 100, -10000.0f, 10000.0f, 0, 0, "AltitudeRate", "m/s"),
    NUMBER(320, 100, -1000.0f, 100000.0f, SKV_CAS_SEA, 0, "BaroCorrectedAltitude", "m"),
    NUMBER(321, 100, -180.0f, 180.0f, 0, 1, "HeadingAngle", "deg"),
    NUMBER(322, 100, -2000.0f, 100000.0f, SKV_CAS_PRESSURE, 0, "StandardAltitude", "m"),
    NUMBER(324, 1000, 100.0f, 400.0f, 0, 0, "StaticAirTemperature", "K"),
    NUMBER(326, 1000, 0.0f, 2000.0f, 0, 0, "StaticPressure", "hPa"),
    NUMBER(332, 100, -1000.0f, 40000000.0f, SKV_CAS_SEA, 0, "TrueAltitude", "m"),
    NUMBER(335, 1000, 100.0f, 400.0f, 0, 0, "OutsideAirTemperature", "K"),
    {1036, 100, POSITION, -90.0f, 90.0f, 1e7f, SKV_CAS_LONG, 0, 0, "Latitude", "deg"},
    {1037, 100, POSITION, -180.0f, 180.0f, 1e7f, SKV_CAS_LONG, 0, 0, "Longitude", "deg"},
    NUMBER(1038, 100, -1000.0f, 40000000.0f, SKV_CAS_ELLIPSOID, 0, "HeightAboveEllipsoid", "m"),
    NUMBER(1039, 100, 0.0f, 20000.0f, 0, 0, "GroundSpeed", "m/s"),
    NUMBER(1040, 100, -180.0f, 180.0f, 0, 1, "TrueTrack", "deg"),
    NUMBER(1070, 100, -100.0f, 100000.0f, SKV_CAS_GROUND, 0, "RadioHeight", "m"),
    NUMBER(1133, 100, -180.0f, 180.0f, 0, 1, "TrueHeading", "deg"),
    BYTES(1200, FOUR_BYTES, SKV_CAS_CHAR4, "UTC"),
    BYTES(1206, FOUR_BYTES, SKV_CAS_CHAR4, "Date"),
    NUMBER(1800, 1000, 0.0f, 360.0f, 0, 2, "SunAzimuth", "deg"),
    NUMBER(1801, 1000, -90.0f, 90.0f, 0, 0, "SunElevation", "deg"),
    NUMBER(1802, 1000, 0.0f, 360.0f, 0, 2, "MoonAzimuth", "deg"),
    NUMBER(1803, 1000, -90.0f, 90.0f, 0, 0, "MoonElevation", "deg"),
    NUMBER(1804, 1000, 0.0f, 180.0f, 0, 0, "MoonPhaseAngle", "deg"),
    NUMBER(1805, 1000, 1.0f, 1000000.0f, 0, 0, "Visibility", "m"),
    NUMBER(1806, 1000, 0.0f, 1000000.0f, 0, 0, "Exposure", "m2/cd"),
    NUMBER(1807, 1000, 0.0f, 10000000.0f, 0, 0, "ZenithLuminance", "cd/m2"),
    BYTES(1808, T(SKV_CAS_UCHAR4), SKV_CAS_UCHAR4, "SkyState"),
    {1809, 1000, T(SKV_CAS_LONG) | F, -86400.0f, 86400.0f, 1.0f, SKV_CAS_LONG, 0, 0, "TimeOffset", "s"},
    NUMBER(1810, 1000, 1.0f, 1000000.0f, 0, 0, "VisibilitySetting", "m"),
};

int skv_cas_find(uint32_t id) {
    int low = 0, high = SKV_CAS_MESSAGES;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (skv_cas_table[middle].id < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low < SKV_CAS_MESSAGES && skv_cas_table[low].id == id ? low : -1;
}

const char *skv_cas_count_name(skv_cas_count count) {
    static const char *const name[SKV_CAS_COUNTS] = {
        "accepted",     "half of a double", "service",    "unknown id", "bus error",     "bad format",
        "wrong length", "wrong service",    "wrong type", "not finite", "out of range",  "duplicate",
        "out of order", "other node",       "missing",    "restart",    "unpaired half", "went stale",
    };
    return (unsigned)count < SKV_CAS_COUNTS ? name[count] : "?";
}
