/// UTM, UPS and MGRS.
#include "fence.hh"
#include "parse.hh"

#include <charconv>

#include <GeographicLib/MGRS.hpp>
#include <GeographicLib/UTMUPS.hpp>

using namespace skv_geo;
using GeographicLib::MGRS;
using GeographicLib::UTMUPS;

namespace {

Refusal refuse(const std::string &why) {
    return Refusal(SKV_ERR_RANGE, why);
}

size_t count_digits(const std::string &s, size_t from) {
    size_t n = 0;
    while (from + n < s.size() && is_digit(s[from + n]))
        n++;
    return n;
}

size_t count_letters(const std::string &s, size_t from) {
    size_t n = 0;
    while (from + n < s.size() && is_letter(s[from + n]))
        n++;
    return n;
}

/// Zone and hemisphere or latitude band. UPS has zone 0.
struct Zone {
    int number;
    bool north;
    char band;      ///< 0 where a hemisphere was given
    bool ambiguous; ///< a capital S: southern hemisphere, or the northern band S
};

bool band_exists(char band) {
    return band >= 'C' && band <= 'X' && band != 'I' && band != 'O';
}

/// Bands are 8 deg high from 80 S on, the last one 12.
double band_bottom(char band) {
    const int letter = band - 'C' - (band > 'I') - (band > 'O');
    return -80 + 8 * letter;
}

double band_top(char band) {
    return band == 'X' ? 84 : band_bottom(band) + 8;
}

/// A word like 32T, 32n, 32south, n, Y; nothing where it is something else.
std::optional<Zone> read_zone(const std::string &word) {
    const size_t digits = count_digits(word, 0);
    if (digits > 2 || digits + count_letters(word, digits) != word.size() || digits == word.size())
        return {};
    std::string name;
    for (size_t i = digits; i < word.size(); i++)
        name += upper(word[i]);
    const int number = digits ? std::stoi(word.substr(0, digits)) : 0;
    if (digits && (number < 1 || number > 60))
        throw refuse("zone " + std::to_string(number) + " is outside 1 to 60");
    if (name == "N" || name == "NORTH" || name == "S" || name == "SOUTH")
        return Zone{number, name[0] == 'N', 0, digits && word.substr(digits) == "S"};
    if (name.size() != 1)
        return {};
    const char band = name[0];
    if (!digits && (band == 'A' || band == 'B' || band == 'Y' || band == 'Z'))
        return Zone{0, band >= 'Y', 0, false};
    if (!digits)
        return {};
    if (!band_exists(band))
        throw refuse("there is no latitude band " + name + " (C to X without I and O)");
    return Zone{number, band >= 'N', band, false};
}

/// Metres; locale-independent.
double read_metres(const std::string &word) {
    double x = 0;
    const char *first = word.data() + (word[0] == '+' ? 1 : 0), *last = word.data() + word.size();
    const auto result = std::from_chars(first, last, x, std::chars_format::fixed);
    if (result.ec != std::errc() || result.ptr != last || !std::isfinite(x))
        throw refuse("'" + word + "' is no number of metres");
    return x;
}

void check_band(const Zone &zone, double lat_deg) {
    const double slack = 0.01; // a point on the edge of a band may be written with either letter: 1 km
    if (zone.band && !within(lat_deg, band_bottom(zone.band) - slack, band_top(zone.band) + slack)) {
        char line[120];
        std::snprintf(line, sizeof line, "it lies at latitude %.3f, outside band %c (%.0f to %.0f)", lat_deg, zone.band,
                      band_bottom(zone.band), band_top(zone.band));
        throw refuse(line);
    }
}

LatLon from_metres(const Zone &zone, double easting_m, double northing_m) {
    // Northings of 32 to 40 deg north, over the width of a zone.
    if (zone.ambiguous && within(northing_m, 3.53e6, 4.44e6))
        throw refuse("zone " + std::to_string(zone.number) +
                     "S may be the southern hemisphere or band S: write south or north");
    LatLon p{};
    UTMUPS::Reverse(zone.number, zone.north, easting_m, northing_m, p.lat_deg, p.lon_deg);
    check_band(zone, p.lat_deg);
    return p;
}

/// 32TMT6500056000, 32TMT: digits of the zone, its letters and what follows. Three letters make it MGRS.
bool looks_like_mgrs(const std::string &whole) {
    const size_t zone = count_digits(whole, 0);
    const size_t letters = count_letters(whole, zone);
    const size_t digits = count_digits(whole, zone + letters);
    const bool polar = zone == 0 && std::string("ABYZ").find(upper(whole[0])) != std::string::npos;
    if (zone > 2 || (zone == 0 && !polar) || zone + letters + digits != whole.size())
        return false;
    return letters == 3 || (letters == 1 && zone > 0 && digits == 0); // the latter: a bare grid zone
}

bool all_digits(const std::string &s) {
    return count_digits(s, 0) == s.size();
}

void check_halves(const Words &words) {
    const size_t n = words.size();
    if (n >= 3 && all_digits(words[n - 1]) && all_digits(words[n - 2]) && words[n - 1].size() != words[n - 2].size())
        throw refuse("easting and northing have different numbers of digits");
}

bool looks_like_number(const std::string &s) {
    return s.find_first_not_of("+-.0123456789") == std::string::npos;
}

} // namespace

std::optional<LatLon> skv_geo::read_mgrs(const Words &words) {
    std::string whole;
    for (const std::string &w : words)
        whole += w;
    if (words.size() > 4 || !looks_like_mgrs(whole))
        return {};
    check_halves(words);
    int zone, precision;
    bool north;
    double easting_m, northing_m;
    const bool middle = true;
    MGRS::Reverse(whole, zone, north, easting_m, northing_m, precision, middle);
    if (precision < 1)
        throw refuse("a grid square of " + std::string(precision < 0 ? "a whole zone" : "100 km") +
                     " is too coarse (at least 1 + 1 digits)");
    LatLon p{};
    UTMUPS::Reverse(zone, north, easting_m, northing_m, p.lat_deg, p.lon_deg, true);
    return p;
}

std::optional<LatLon> skv_geo::read_utm(const Words &words) {
    if (words.size() != 3)
        return {};
    // "8E 47 N" is no zone 8 with band E: the other two words must be numbers.
    if (!looks_like_number(words[1]) || looks_like_number(words[0]) == looks_like_number(words[2]))
        return {};
    const bool zone_first = looks_like_number(words[2]);
    const auto zone = read_zone(words[zone_first ? 0 : 2]);
    if (!zone)
        return {};
    const size_t e = zone_first ? 1 : 0;
    return from_metres(*zone, read_metres(words[e]), read_metres(words[e + 1]));
}
