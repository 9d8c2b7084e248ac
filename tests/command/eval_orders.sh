#!/usr/bin/env bash
# `skyvert eval --orders all`: what physics demands of light scattered more than once, and a path tracer's answers.
cd "$(dirname "$0")" && here=$PWD && root=$here/../.. && cd - >/dev/null
. "$here/lib.sh"
cp "$here/air.ini" "$root"/tools/bench/br1*.ini "$here"/orders_truth_*.csv "$work"
cd "$work" || exit 1
head=altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg
printf '%s\n' $head 1,60,50,30 >one.csv
run one.csv "$skyvert" eval --atmosphere air.ini
case $(cat stderr) in *libinih*) echo "skipped: this build lacks libinih (package libinih-dev)" && exit 77 ;; esac

# answers NAME QUERIES OPTION...: into NAME
answers() {
    does "$1: ${*:3}" "$2" "$skyvert" eval "${@:3}"
    cp stdout "$1"
}
# holds CASE AWK FILE...: awk prints a line for each row that breaks the rule; further lines go through as figures
holds() {
    cases=$((cases + 1))
    awk -F, "$2" "${@:3}" >out
    grep '^figure:' out
    grep -qv '^figure:' out || return
    bad=$((bad + 1))
    echo "FAILED $1:" && grep -v '^figure:' out | head -n 8
}

# ---- any observer, any sun, any direction: finite, and never less than light scattered once
awk -v head=$head 'BEGIN { srand(4); print head
    for (i = 0; i < 600; i++) { u = rand(); h = u < .2 ? 0 : u < .6 ? 20 * rand() : u < .9 ? 300 * rand() : 10 ^ (6 * rand())
        printf "%.9g,%.9g,%.9g,%.9g\n", i % 40 ? h : 1e6, i % 30 ? 180 * rand() : 108, 180 * rand(), 360 * rand() } }' >q.csv
for air in br16.ini br17o.ini; do
    for ground in none lit; do
        answers once.csv q.csv --atmosphere $air --ground $ground --orders single
        answers all.csv q.csv --atmosphere $air --ground $ground
        # The sum is rounded to nearest: nothing is lost. NaN and infinity are no numbers to awk: they fail the second half.
        paste -d, once.csv all.csv >pair.csv
        holds "$air, ground $ground: all >= once" 'NR > 1 { for (i = 5; i <= 8; i++) { a = $(i + 8)
            if (!(a + 0 >= $i + 0) || a !~ /^[0-9.]+(e[-+][0-9]+)?$/) print "row " NR ": all " a ", once " $i } }' pair.csv
    done
    answers none.csv q.csv --atmosphere $air --ground none
    paste -d, none.csv all.csv >pair.csv
    holds "$air: the lit ground adds below the horizon and nothing above" 'NR > 1 { r = 6360 / (6360 + $1); s = 1 - r * r; s = s > 0 ? sqrt(s) : 0
        mu = cos($3 * atan2(0, -1) / 180)
        for (i = 5; i <= 8; i++) { if ($(i + 8) + 0 < $i + 0) print "row " NR ": lit " $(i + 8) ", none " $i
            if (mu > -s + 1e-4 && $(i + 8) != $i) print "row " NR ": sky, lit " $(i + 8) ", none " $i } }' pair.csv
done

# ---- azimuth: a ray and its mirror image see the same. 1e-4: their directions differ by a rounding, 6e-8, which counts most at the
# planet's shadow and at tangency.
awk -F, -v OFS=, 'NR > 1 { $4 = -$4 } { print }' q.csv >mirrored.csv
answers here.csv q.csv --atmosphere br16.ini
answers there.csv mirrored.csv --atmosphere br16.ini
paste -d, here.csv there.csv >pair.csv
holds "mirrored azimuths" 'NR > 1 { for (i = 5; i <= 8; i++) { d = $i - $(i + 8); if (d < 0) d = -d
    if (d > 1e-4 * $i) print "row " NR ": " $i " and " $(i + 8) } }' pair.csv

# ---- each row for itself: the answers do not depend on what stands beside it
{ head -n 1 q.csv && tail -n +2 q.csv | tac; } >turned.csv
answers turned_all.csv turned.csv --atmosphere br16.ini
same "rows turned round" "$(tail -n +2 turned_all.csv | tac)" "$(tail -n +2 here.csv)"

# ---- the rule is that of light scattered once; what is added is the same
for rule in 'keller --samples 32' 'uniform --samples 64' 'gauss-exp --samples 12'; do
    answers once.csv q.csv --atmosphere br17o.ini --rule $rule --orders single
    answers all.csv q.csv --atmosphere br17o.ini --rule $rule
    paste -d, once.csv all.csv >"rule ${rule%% *}"
done
# 3 % of the light that is added: only gauss-exp cuts its rays into slices, and the table's own integral goes with it.
holds "what is added does not depend on the rule" '
    FILENAME == "rule gauss-exp" { for (i = 5; i <= 8; i++) want[FNR, i] = $(i + 8) - $i; next }
    FNR > 1 { for (i = 5; i <= 8; i++) { d = $(i + 8) - $i - want[FNR, i]; if (d < 0) d = -d
        if (d > .03 * want[FNR, i] + 1e-5 * $i) print FILENAME " row " FNR ": " $(i + 8) - $i ", want " want[FNR, i] } }' \
    "rule gauss-exp" "rule keller" "rule uniform"

# ---- thin air over a black ground: once is all. Scattered twice is at most the depth of a horizontal ray, 1e-4 * 8 * 45.
cat >thin.ini <<'INI'
[planet]
radius_km = 100000
top_km = 100
albedo = 0, 0.25, 0.5, 1
[bands]
wavelength_nm = 440, 520, 600, 680
solar_irradiance = 1, 1, 1, 1
[rayleigh]
scattering_per_km = 1e-5, 1e-5, 1e-5, 1e-5
profile = exponential
scale_height_km = 8
INI
awk -v head=$head 'BEGIN { srand(5); print head; for (i = 0; i < 100; i++) printf "%.6g,%.6g,%.6g,%.6g\n", 3 * rand(), 80 * rand(), 80 * rand(), 360 * rand() }' >day.csv
answers once.csv day.csv --atmosphere thin.ini --orders single
answers all.csv day.csv --atmosphere thin.ini
paste -d, once.csv all.csv >pair.csv
holds "thin air over a black ground: once is all" 'NR > 1 { e = $13 / $5 - 1; if (!(e >= 0 && e < .003)) print "row " NR ": all/once - 1 = " e }' pair.csv
# Over a ground of albedo a the sky is also lit from below, by a cos(z)/pi from a half space. In the zenith Rayleigh scatters
# half of that: tau a cos(z)/(2 pi), where light scattered once has tau 3/(16 pi) (1 + cos(z)^2). The sphere (H/R = 8e-5), what
# is scattered three times (tau = 8e-5) and the fit of nine numbers, which holds all that Rayleigh's law asks for: 1 %.
for z in 0 30 60 75; do echo 0,$z,0,0; done | cat <(echo $head) - >zenith.csv
answers once.csv zenith.csv --atmosphere thin.ini --orders single
answers all.csv zenith.csv --atmosphere thin.ini
paste -d, once.csv all.csv >pair.csv
holds "thin air over a bright ground" 'NR > 1 { c = cos($2 * atan2(0, -1) / 180); split("0 .25 .5 1", a, " ")
    for (i = 1; i <= 4; i++) { want = 1 + a[i] * 8 * c / (3 * (1 + c * c)); got = $(i + 12) / $(i + 4); e = got / want - 1
        if (e < 0) e = -e; if (e > worst) worst = e
        if (!(e <= .01)) print "sun zenith " $2 ", albedo " a[i] ": all/once " got ", want " want } }
    END { printf "figure: eval, thin air over a bright ground: worst error %.4f\n", worst }' pair.csv

# ---- energy: air that does not absorb over a white ground sends all light back. Over a nearly flat planet the flux up
# through the top is the sun's, cos(z); Gauss-Legendre in the cosine from the nadir to the limb, 12 azimuths.
cat >white.ini <<'INI'
[planet]
radius_km = 100000
top_km = 80
albedo = 1, 1, 1, 1
[bands]
wavelength_nm = 440, 520, 600, 680
solar_irradiance = 1, 1, 1, 1
[rayleigh]
scattering_per_km = 0.04, 0.02, 0.01, 0.001
profile = exponential
scale_height_km = 8
[aerosol]
scattering_per_km = 0.1, 0.1, 0.1, 0.02
extinction_per_km = 0.1, 0.1, 0.1, 0.02
profile = exponential
scale_height_km = 1.2
phase = henyey-greenstein
g = 0.7
INI
# Midpoints in t with cos = t^2: rays gather at the limb.
awk -v head=$head 'BEGIN { print head; pi = atan2(0, -1); for (z = 0; z <= 75; z += 25) for (i = 0; i < 24; i++) for (k = 0; k < 12; k++) {
    t = (i + .5) / 24; c = t * t; printf "80,%d,%.9f,%.6g\n", z, 180 - atan2(sqrt(1 - c * c), c) * 180 / pi, 15 * (k + .5) } }' >up.csv
answers up_all.csv up.csv --atmosphere white.ini --ground lit
# 2.5 %: the day's error of nine numbers a cell (1 % by day), and the ground's own share of it.
holds "energy over a white ground" 'NR > 1 { pi = atan2(0, -1); j = NR - 2; i = int(j / 12) % 24; t = (i + .5) / 24; c = t * t
        for (b = 1; b <= 4; b++) flux[$2, b] += $(b + 4) * c * 2 * t / 24 * 2 * pi / 12; sun[$2] = cos($2 * pi / 180) }
    END { for (z in sun) for (b = 1; b <= 4; b++) { e = flux[z, b] / sun[z] - 1; if (e * e > worst * worst) worst = e
            if (e > .025 || e < -.025) print "sun zenith " z ", band " b ": flux up/flux down " 1 + e }
        printf "figure: eval, energy that a white planet sends back: worst error %.4f\n", worst }' up_all.csv
# Over a black ground some of it stays: never more than came.
sed 's/^albedo.*/albedo = 0, 0, 0, 0/' white.ini >black.ini
answers up_all.csv up.csv --atmosphere black.ini --ground lit
holds "energy over a black ground" 'NR > 1 { pi = atan2(0, -1); j = NR - 2; i = int(j / 12) % 24; t = (i + .5) / 24; c = t * t
        for (b = 1; b <= 4; b++) flux[$2, b] += $(b + 4) * c * 2 * t / 24 * 2 * pi / 12; sun[$2] = cos($2 * pi / 180) }
    END { for (z in sun) for (b = 1; b <= 4; b++) if (!(flux[z, b] < sun[z] && flux[z, b] > 0)) print "sun zenith " z ", band " b ": " flux[z, b] / sun[z] }' up_all.csv

# ---- the path tracer (tools/reference): answers with their standard errors E_, 20 to 60 km, sun from the zenith to 92 deg.
# Error: the largest channel's over the largest channel. Sets are small: the limits are the project's mean (1 % by
# day), twice what was found for a single ray, and the tracer's noise.
for set in hazy:br16 clear:br17o; do
    truth=orders_truth_${set%:*}.csv
    for table in accurate:.01:.08 small:.015:.1; do
        IFS=: read -r kind mean most <<<"$table"
        answers got.csv $truth --atmosphere ${set#*:}.ini --ground lit --table $kind
        paste -d, $truth got.csv >pair.csv
        holds "${set%:*}, $kind table, against the path tracer" 'NR > 1 { m = 0; w = 0; s = 0
                for (i = 5; i <= 8; i++) { d = $i - $(i + 12); if (d < 0) d = -d; if (d > w) w = d; if ($i > m) m = $i; if ($(i + 4) > s) s = $(i + 4) }
                e = w / m; sum += e; n++; if (e > worst) worst = e; noise += s / m
                if (e > '$most' + 3 * s / m) print "row " NR ": " $1 " km, sun " $2 ", view " $3 ", azimuth " $4 ": error " e }
            END { printf "figure: eval --table '$kind' against the path tracer, '${set%:*}' air: mean %.4f, worst %.4f (the tracer itself %.4f)\n", sum / n, worst, noise / n
                if (sum / n > '$mean' + noise / n) print "mean " sum / n }' pair.csv
    done
done
finish
