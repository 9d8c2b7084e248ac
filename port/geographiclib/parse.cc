/// One parser for the ways people write a position.
#include "fence.hh"
#include "parse.hh"

#include <cstring>

#include <GeographicLib/Math.hpp>

using namespace skv_geo;

namespace {

const size_t longest = 200;
const char allowed[] = "allowed: 47.46, 8.55 | 47:27:32N 8:32:2E | 32T 465000 5256000 | 32TMT6500056000";

Words split(const std::string &text) {
    Words words(1);
    for (const char c : text)
        if (!is_blank(c) && c != ',')
            words.back() += c;
        else if (!words.back().empty())
            words.emplace_back();
    if (words.back().empty())
        words.pop_back();
    return words;
}

LatLon read(const std::string &text) {
    const Words words = split(text);
    if (words.empty())
        throw Refusal(SKV_ERR_RANGE, "there is nothing in it");
    if (const auto p = read_mgrs(words))
        return *p;
    if (const auto p = read_utm(words))
        return *p;
    return read_angles(text, words);
}

/// At most 60 bytes of the text and 140 of the reason, so that the allowed forms always fit.
std::string complaint(const std::string &text, const std::string &why) {
    const std::string shown = text.size() > 60 ? text.substr(0, 57) + "..." : text;
    const std::string reason = why.size() > 140 ? why.substr(0, 137) + "..." : why;
    return "position '" + shown + "': " + reason + "; " + allowed;
}

} // namespace

skv_status skv_geo_parse(const char *text, double *lat_deg, double *lon_deg, char *message, size_t size) {
    if (!text || !lat_deg || !lon_deg)
        return SKV_ERR_NULL;
    return fenced(message, size, SKV_ERR_RANGE, [&] {
        const std::string line(text, strnlen(text, longest + 1));
        try {
            if (line.size() > longest)
                throw Refusal(SKV_ERR_RANGE, "longer than " + std::to_string(longest) + " bytes");
            const LatLon p = read(line);
            if (!within(p.lat_deg, -90, 90) || !within(p.lon_deg, -180, 360))
                throw Refusal(SKV_ERR_RANGE, "not a finite position");
            *lat_deg = p.lat_deg;
            *lon_deg = GeographicLib::Math::AngNormalize(p.lon_deg);
        } catch (const std::runtime_error &e) {
            throw Refusal(SKV_ERR_RANGE, complaint(line, e.what()));
        }
        return SKV_OK;
    });
}
