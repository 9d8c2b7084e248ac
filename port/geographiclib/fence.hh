/// What the files of this port share: the fence that no exception passes, messages, and range checks.
#ifndef SKV_GEO_FENCE_HH
#define SKV_GEO_FENCE_HH

#include <cmath>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#include "skv_geo.h"

namespace skv_geo {

/// A refusal with its status and one line for the user.
struct Refusal : std::runtime_error {
    skv_status status;
    Refusal(skv_status s, const std::string &line) : std::runtime_error(line), status(s) {}
};

/// Puts one line into the caller's message; control characters become blanks.
inline void say(char *message, size_t size, const char *line) noexcept {
    if (!message || size == 0)
        return;
    std::snprintf(message, size, "%s", line);
    for (char *c = message; *c; c++)
        if (static_cast<unsigned char>(*c) < ' ' || *c == 127)
            *c = ' ';
}

/// Runs body, which returns a status; whatever it throws becomes `otherwise`, or what a Refusal carries.
template <class Body> skv_status fenced(char *message, size_t size, skv_status otherwise, Body body) noexcept {
    try {
        return body();
    } catch (const Refusal &e) {
        say(message, size, e.what());
        return e.status;
    } catch (const std::bad_alloc &) {
        say(message, size, "out of memory");
        return SKV_ERR_SIZE;
    } catch (const std::exception &e) {
        say(message, size, e.what());
        return otherwise;
    } catch (...) {
        say(message, size, "unknown failure");
        return otherwise;
    }
}

template <class Body> skv_status fenced(Body body) noexcept {
    return fenced(nullptr, 0, SKV_ERR_RANGE, body);
}

/// False for NaN too.
inline bool within(double x, double low, double high) noexcept {
    return x >= low && x <= high;
}

inline bool position_ok(double lat_deg, double lon_deg) noexcept {
    return within(lat_deg, -90, 90) && within(lon_deg, -180, 360);
}

inline bool height_ok(double height_m) noexcept {
    return within(height_m, -20e3, 1e9);
}

inline bool finite3(const double v[3]) noexcept {
    return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

} // namespace skv_geo
#endif
