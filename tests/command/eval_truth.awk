# An integrator of its own, in double: single scattering for the queries on the standard input, atmosphere from FILE
# (-v ini=FILE -v ground=0|1). Midpoints of steps ending at L(i/n)^3, plain sums for the depth; no closed forms.
function parse(   line, section, key, value) {
    while ((getline line < ini) > 0) {
        if (line ~ /^\[/) section = substr(line, 2, length(line) - 2)
        if (line ~ /^[a-z]/) {
            key = line; sub(/ *=.*/, "", key)
            value = line; sub(/^[^=]*= */, "", value)
            air[section, key] = value
        }
    }
    R = air["planet", "radius_km"]; top = air["planet", "top_km"]
    list("planet", "albedo", albedo); list("bands", "solar_irradiance", sun)
    list("rayleigh", "scattering_per_km", ray); list("aerosol", "scattering_per_km", aer)
    list("aerosol", "extinction_per_km", aerx); list("ozone", "absorption_per_km", ozo)
}
function list(section, key, out,   parts, n, i) {
    n = split(air[section, key], parts, ",")
    for (i = 1; i <= n; i++) out[i] = parts[i] + 0
    bands = n
}
function min(a, b) { return a < b ? a : b }
function tent(h,   d) {
    d = h - air["ozone", "peak_km"]; if (d < 0) d = -d
    d = 1 - d / air["ozone", "half_width_km"]
    return d > 0 ? d : 0
}
# Distance from radius r along the cosine mu to the sphere of radius q, the nearest one ahead; -1 if there is none.
function sphere(r, mu, q, inside,   d) {
    d = q * q - r * r * (1 - mu * mu)
    if (d < 0) return -1
    d = inside ? -r * mu + sqrt(d) : -r * mu - sqrt(d)
    return d > 1e-9 ? d : -1
}
# Adds densities times length from r along mu over L to col[1..3].
function depth(r, mu, L, n, col,   i, a, b, s, h, w) {
    col[1] = col[2] = col[3] = 0
    for (i = 0; i < n; i++) {
        a = L * (i / n) ^ 3; b = L * ((i + 1) / n) ^ 3; s = (a + b) / 2; w = b - a
        h = sqrt(r * r + s * s + 2 * r * s * mu) - R
        col[1] += w * exp(-h / air["rayleigh", "scale_height_km"])
        col[2] += w * exp(-h / air["aerosol", "scale_height_km"])
        col[3] += w * tent(h)
    }
}
function tau(band, col) { return ray[band] * col[1] + aerx[band] * col[2] + ozo[band] * col[3] }
BEGIN {
    FS = ","; pi = atan2(0, -1); N = 400; M = 150
    parse()
    g = air["aerosol", "g"]
}
NR > 1 {
    h0 = $1; rad = pi / 180
    mu = cos($3 * rad); mus = cos($2 * rad); nu = mu * mus + sin($3 * rad) * sin($2 * rad) * cos($4 * rad)
    r = R + h0
    hit = mu < 0 ? sphere(r, mu, R, 0) : -1
    L = hit > 0 ? hit : sphere(r, mu, R + top, 1)
    pr = 3 / (16 * pi) * (1 + nu * nu)
    pm = 3 / (8 * pi) * (1 - g * g) / (2 + g * g) * (1 + nu * nu) / (1 + g * g - 2 * g * nu) ^ 1.5
    for (b = 1; b <= bands; b++) sum[b] = 0
    seen[1] = seen[2] = seen[3] = 0
    for (i = 0; i <= N; i++) {
        # Step N is the ground's own point.
        s0 = L * (i / N) ^ 3; s1 = i < N ? L * ((i + 1) / N) ^ 3 : L; s = (s0 + s1) / 2; w = s1 - s0
        rp = sqrt(r * r + s * s + 2 * r * s * mu); h = rp - R
        mp = (r * mus + s * nu) / rp
        d1 = exp(-h / air["rayleigh", "scale_height_km"]); d2 = exp(-h / air["aerosol", "scale_height_km"]); d3 = tent(h)
        lit = mp > 0 || sphere(rp, mp, R, 0) < 0
        if (lit) depth(rp, mp, sphere(rp, mp, R + top, 1), M, col)
        for (b = 1; b <= bands && lit; b++) {
            t = tau(b, col) + tau(b, seen) + w / 2 * (ray[b] * d1 + aerx[b] * d2 + ozo[b] * d3)
            if (i < N) sum[b] += sun[b] * w * (ray[b] * d1 * pr + aer[b] * d2 * pm) * exp(-t)
            else if (hit > 0 && ground && mp > 0) sum[b] += sun[b] * albedo[b] / pi * mp * exp(-t)
        }
        seen[1] += w * d1; seen[2] += w * d2; seen[3] += w * d3
    }
    printf "%s,%s,%s,%s", $1, $2, $3, $4
    for (b = 1; b <= bands; b++) printf ",%.9g", sum[b]
    print ""
}
