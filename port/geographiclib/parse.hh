/// The parts of the position parser. Each throws an exception whose text says what is wrong.
#ifndef SKV_GEO_PARSE_HH
#define SKV_GEO_PARSE_HH

#include <optional>
#include <string>
#include <vector>

namespace skv_geo {

struct LatLon {
    double lat_deg, lon_deg;
};
using Words = std::vector<std::string>;

/// Characters of plain ASCII whatever the locale.
inline bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
inline bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
inline char upper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
inline bool is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Nothing where the words do not look like this form at all.
std::optional<LatLon> read_mgrs(const Words &words);
std::optional<LatLon> read_utm(const Words &words);

/// Decimal degrees and degrees, minutes, seconds: what is left when it is no grid.
LatLon read_angles(const std::string &text, const Words &words);

} // namespace skv_geo
#endif
