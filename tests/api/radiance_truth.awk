# radiance_truth.awk: expected values in double as C rows, for radiance_truth.sh. Lines on the standard input are
# those of skyvert-reference --ground none with those of --ground lit behind them; -v ini=FILE.
# Transmittance and the two midpoint rules are worked out here by plain sums over the profiles: no closed forms.
function parse(   line, section, key, value) {
    while ((getline line < ini) > 0) {
        if (line ~ /^\[/) section = substr(line, 2, length(line) - 2)
        if (line ~ /^[a-z]/) {
            key = line; sub(/ *=.*/, "", key)
            value = line; sub(/^[^=]*= */, "", value)
            air[section, key] = value
        }
    }
    R = air["planet", "radius_km"] + 0; top = air["planet", "top_km"] + 0; g = air["aerosol", "g"] + 0
    Hr = air["rayleigh", "scale_height_km"] + 0; Ha = air["aerosol", "scale_height_km"] + 0
    has_ozone = ("ozone", "peak_km") in air
    peak = air["ozone", "peak_km"] + 0; half = air["ozone", "half_width_km"] + 0
    list("rayleigh", "scattering_per_km", ray); list("aerosol", "scattering_per_km", aer)
    list("aerosol", "extinction_per_km", aerx); list("ozone", "absorption_per_km", ozo)
}
function list(section, key, out,   parts, n, i) {
    n = split(air[section, key], parts, ",")
    for (i = 1; i <= 4; i++) out[i] = i <= n ? parts[i] + 0 : 0
}
function cosine(deg) { return deg == 90 ? 0 : deg == 180 ? -1 : cos(deg * pi / 180) }
function sine(deg) { return deg == 180 ? 0 : sin(deg * pi / 180) }
function tent(h,   d) { d = h - peak; d = 1 - (d < 0 ? -d : d) / half; return has_ozone && d > 0 ? d : 0 }
# Far and near distance from altitude h (rm = r mu) to the sphere of altitude q; c keeps its digits near the sphere.
function discriminant(h, rm, q) { return rm * rm - (h - q) * (2 * R + h + q) }
function outwards(h, rm, q,   d) { d = discriminant(h, rm, q); return -rm + sqrt(d > 0 ? d : 0) }
function inwards(h, rm, q) { return (h - q) * (2 * R + h + q) / (-rm + sqrt(discriminant(h, rm, q))) }
function altitude(h, rm, s,   e) { e = h * (2 * R + h) + s * (2 * rm + s); return e / (R + sqrt(R * R + e)) }
# Adds to col[] the columns of M steps from (h, rm) over L; steps end at L (j/M)^power.
function steps(h, rm, L, M, power, col,   j, a, b, q) {
    for (j = 0; j < M; j++) {
        a = (j / M) ^ power; b = ((j + 1) / M) ^ power
        q = altitude(h, rm, L * (a + b) / 2)
        col[1] += L * (b - a) * exp(-q / Hr); col[2] += L * (b - a) * exp(-q / Ha); col[3] += L * (b - a) * tent(q)
    }
}
function tau(band, col) { return ray[band] * col[1] + aerx[band] * col[2] + ozo[band] * col[3] }
# Fine steps outward from the densest point of the ray.
function transmittance(out,   col, b, t) {
    col[1] = col[2] = col[3] = 0
    if (L > 0 && hit) steps(0, -(rm + L), L, 3000, 3, col)
    else if (L > 0 && rm < 0) {
        t = altitude(h0, rm, -rm)
        steps(t, 0, -rm, 3000, 3, col); steps(t, 0, L + rm, 3000, 3, col)
    } else if (L > 0) steps(h0, rm, L, 3000, 3, col)
    for (b = 1; b <= 4; b++) out[b] = exp(-tau(b, col))
}
function rule(n, m, view_power, depth_power, out,   i, b, a, c, s, h, r, rms, w, col, t) {
    for (b = 1; b <= 4; b++) out[b] = 0
    for (i = 0; i < n && L > 0; i++) {
        a = (i / n) ^ view_power; c = ((i + 1) / n) ^ view_power
        s = L * (a + c) / 2; w = L * (c - a)
        h = altitude(h0, rm, s); r = R + h; rms = rms0 + s * nu
        if (rms < 0 && r * r - rms * rms < R * R) continue
        col[1] = col[2] = col[3] = 0
        steps(h, rms, outwards(h, rms, top), m, depth_power, col)
        steps(h, -(rm + s), s, m, depth_power, col)
        for (b = 1; b <= 4; b++)
            out[b] += w * (ray[b] * exp(-h / Hr) * pr + aer[b] * exp(-h / Ha) * pm) * exp(-tau(b, col))
    }
}
# A float literal needs a point or an exponent.
function literal(x) { x = sprintf("%.8g", x); return (x ~ /[.e]/ ? x : x ".0") "f" }
function braces(x) { return "{" literal(x[1]) ", " literal(x[2]) ", " literal(x[3]) ", " literal(x[4]) "}" }
BEGIN { FS = ","; pi = atan2(0, -1); parse() }
NR > 1 {
    h0 = $1 + 0; mu = cosine($3); mus = cosine($2)
    nu = mu * mus + sine($3) * sine($2) * cosine($4)
    pr = 3 / (16 * pi) * (1 + nu * nu)
    pm = 3 / (8 * pi) * (1 - g * g) / (2 + g * g) * (1 + nu * nu) / (1 + g * g - 2 * g * nu) ^ 1.5
    rm = (R + h0) * mu; rms0 = (R + h0) * mus; enters = 1
    if (h0 > top) { # to where the air begins
        enters = rm < 0 && discriminant(h0, rm, top) > 0
        if (enters) { s = inwards(h0, rm, top); rm += s; rms0 += s * nu; h0 = top }
    }
    hit = rm < 0 && discriminant(h0, rm, 0) > 0
    L = !enters ? 0 : hit ? inwards(h0, rm, 0) : outwards(h0, rm, top)
    for (b = 1; b <= 4; b++) { converged[b] = $(b + 4); lit[b] = $(b + 12) }
    transmittance(through); rule(16, 16, 3, 2, keller); rule(64, 16, 1, 1, uniform)
    print "    {" literal($1) ", " literal($2) ", " literal($3) ", " literal($4) ", " braces(converged) ","
    print "     " braces(lit) ","
    print "     " braces(through) ","
    print "     " braces(keller) ","
    print "     " braces(uniform) "},"
}
