/// Decimal degrees and degrees, minutes, seconds. GeographicLib reads one angle; here the text is cut into two, and
/// what it would read in a surprising way is refused: sums, signs beside a hemisphere letter, decimal commas.
#include "fence.hh"
#include "parse.hh"

#include <GeographicLib/DMS.hpp>

using namespace skv_geo;
using GeographicLib::DMS;

namespace {

struct Angle {
    double deg;
    DMS::flag axis;
};

Refusal refuse(const std::string &why) {
    return Refusal(SKV_ERR_RANGE, why);
}

bool is_hemisphere(char c) {
    return c != '\0' && std::string("NSEWnsew").find(c) != std::string::npos;
}

/// Blanks between numbers are colons: "47 27 32 N" is 47:27:32N. After a unit mark, and beside a letter, they are
/// nothing.
std::string close_up(const std::string &part) {
    std::string out;
    bool gap = false;
    for (const char c : part) {
        if (is_blank(c)) {
            gap = true;
            continue;
        }
        if (c == ',')
            throw refuse("a comma within an angle (the decimal sign is a point)");
        if (gap && !out.empty() && is_digit(c) && (is_digit(out.back()) || out.back() == '.'))
            out += ':';
        out += c;
        gap = false;
    }
    return out;
}

std::string trim(const std::string &s) {
    const char *edge = " \t\n\v\f\r,";
    const size_t first = s.find_first_not_of(edge);
    return first == std::string::npos ? "" : s.substr(first, s.find_last_not_of(edge) - first + 1);
}

/// Aeronautical charts and IGC files write DDMM[SS], DDDMM[SS] without marks. No latitude has four digits of degrees.
std::string add_colons(const std::string &angle) {
    const size_t first = !angle.empty() && is_hemisphere(angle.front()) ? 1 : 0;
    size_t digits = 0;
    while (first + digits < angle.size() && is_digit(angle[first + digits]))
        digits++;
    const size_t after = first + digits;
    if (after < angle.size() && angle[after] != '.' && !is_hemisphere(angle[after]))
        return angle;
    const char letter = upper(first ? angle.front() : angle.back());
    const size_t degrees = letter == 'N' || letter == 'S' ? 2 : letter == 'E' || letter == 'W' ? 3 : 0;
    if (degrees == 0 || (digits != degrees + 2 && digits != degrees + 4))
        return angle;
    std::string out = angle;
    if (digits == degrees + 4)
        out.insert(first + degrees + 2, ":");
    return out.insert(first + degrees, ":");
}

void check_letters(const Words &words) {
    for (const std::string &word : words)
        for (const char c : word)
            if (is_letter(c) && upper(c) != 'D' && !is_hemisphere(c))
                throw refuse("'" + word + "' is no angle");
}

Angle read_angle(const std::string &word) {
    size_t letters = 0, signs = 0;
    for (const char c : word) {
        letters += is_hemisphere(c);
        signs += c == '+' || c == '-';
    }
    if (letters && signs)
        throw refuse("'" + word + "' has a sign and a hemisphere letter");
    if (signs > 1 || (signs == 1 && word[0] != '+' && word[0] != '-'))
        throw refuse("'" + word + "' has a sign inside");
    Angle a{0, DMS::NONE};
    a.deg = DMS::Decode(add_colons(word), a.axis);
    if (!std::isfinite(a.deg))
        throw refuse("'" + word + "' is not finite");
    return a;
}

/// The two angles of a text with two hemisphere letters: cut after the first letter, or before the second where the
/// letters lead.
Words cut_at_letters(const std::string &text, size_t letter1, size_t letter2) {
    const std::string whole = trim(text);
    const bool leading = is_hemisphere(whole.front());
    const size_t cut = leading ? letter2 : letter1 + 1;
    return {close_up(trim(text.substr(0, cut))), close_up(trim(text.substr(cut)))};
}

Words two_angles(const std::string &text, const Words &words) {
    std::vector<size_t> letters;
    for (size_t i = 0; i < text.size(); i++)
        if (is_hemisphere(text[i]))
            letters.push_back(i);
    if (letters.size() == 2)
        return cut_at_letters(text, letters[0], letters[1]);
    if (words.size() != 2)
        throw refuse("it should be a latitude and a longitude, but has " + std::to_string(words.size()) +
                     (words.size() == 1 ? " part" : " parts"));
    return words;
}

std::string number(double deg) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.10g", deg);
    return buffer;
}

} // namespace

LatLon skv_geo::read_angles(const std::string &text, const Words &words) {
    check_letters(words);
    const Words part = two_angles(text, words);
    const Angle a = read_angle(part[0]), b = read_angle(part[1]);
    if (a.axis != DMS::NONE && a.axis == b.axis)
        throw refuse(a.axis == DMS::LATITUDE ? "two latitudes" : "two longitudes");
    const bool swapped = a.axis == DMS::LONGITUDE || b.axis == DMS::LATITUDE;
    const LatLon p = swapped ? LatLon{b.deg, a.deg} : LatLon{a.deg, b.deg};
    if (!within(p.lat_deg, -90, 90))
        throw refuse("latitude " + number(p.lat_deg) + " is outside [-90, 90]");
    if (!within(p.lon_deg, -180, 360))
        throw refuse("longitude " + number(p.lon_deg) + " is outside [-180, 360]");
    return p;
}
