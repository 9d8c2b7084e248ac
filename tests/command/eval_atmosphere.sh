#!/usr/bin/env bash
# Atmosphere files of `skyvert eval`: what is accepted, and the error line of everything that is not.
cd "$(dirname "$0")" && here=$PWD && cd - >/dev/null
. "$here/lib.sh"
cp "$here/air.ini" "$work/air.ini"
cd "$work" || exit 1
printf 'altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg\n1,60,50,30\n' >q.csv
eval_file() { "$skyvert" eval --orders single --atmosphere "$1"; }
run q.csv eval_file air.ini
case $(cat stderr) in *libinih*) echo "skipped: this build lacks libinih (package libinih-dev)" && exit 77 ;; esac
does base q.csv eval_file air.ini
base=$(tail -n 1 stdout)

# edited SED...: air.ini with these edits as edited.ini
edited() { sed "$@" air.ini >edited.ini; }
# wrong CASE LINE PATTERN SED...: the edited file is refused at that line.
wrong() {
    edited "${@:4}"
    refuses "$1" 2 "^edited\.ini:$2: .*($3)" q.csv eval_file edited.ini
}
# right CASE SED...: the edited file gives the same answer as air.ini.
right() {
    edited "${@:2}"
    does "$1" q.csv eval_file edited.ini
    same "$1: answer" "$(tail -n 1 stdout)" "$base"
}

# --- every line of every error ---
wrong 'unknown section' 20 'unknown section \[ozon\].*allowed' 's/\[ozone\]/[ozon]/'
wrong 'unknown empty section' 25 'unknown section \[moon\]' '$a[moon]'
wrong 'unknown key' 3 'unknown key radius in \[planet\]; allowed are radius_km' 's/radius_km/radius/'
wrong 'key in another section' 25 'unknown key g in \[ozone\]' '$ag = .8'
wrong 'key with wrong case' 4 'unknown key Top_km' 's/top_km/Top_km/'
wrong 'duplicate key' 4 'radius_km stands in line 3 already' '4s/.*/radius_km = 6360/'
wrong 'duplicate section' 25 'section \[planet\] stands in line 2' '$a[planet]'
wrong 'key outside a section' 1 'outside a section' '1s/.*/radius_km = 6360/'
wrong 'no equals sign' 3 'no value; allowed is name = value' '3s/ = / /'
wrong 'broken section' 2 'not a section' '2s/]//'
wrong 'text behind a section' 2 'not a section' '2s/$/ x/'
wrong 'missing section' 24 'section \[planet\] is missing|unknown' -e '2s/.*/;/' -e '3,5d' -e '$a;' -e '$a;' -e '$a;'
wrong 'missing key' 2 'lacks radius_km' '3d'
for key in 4:2:top_km 5:2:albedo 7:6:wavelength_nm 8:6:solar_irradiance 10:9:scattering_per_km 11:9:profile \
    12:9:scale_height_km 14:13:scattering_per_km 15:13:extinction_per_km 16:13:profile 17:13:scale_height_km \
    18:13:phase 19:13:g 21:20:absorption_per_km 22:20:profile 23:20:peak_km 24:20:half_width_km; do
    IFS=: read -r at section name <<<"$key"
    wrong "missing $name" "$section" "lacks $name" "${at}s/.*/;/"
done
wrong 'value left out' 3 'radius_km = : allowed is a number' '3s/6360//'
for value in nan inf -inf 0x10 1e400 '6360 km' '6,360' '6360,' 1e5000 -6360 0 1e-320 100001 '--6360' '6.3.6' '1e' '.' '6360 6360'; do
    wrong "radius_km = $value" 3 'radius_km = .*: allowed is a number from 1 to 100000' "3s/6360/$value/"
done
wrong 'top above radius' 4 'allowed is at most radius_km' '3s/6360/50/'
wrong 'top too high' 4 'from 0.1 to 1000' '4s/60/1001/'
wrong 'albedo over 1' 5 'albedo = .*1.01: allowed is a number from 0 to 1' 's/0.4$/1.01/'
wrong 'negative albedo' 5 'from 0 to 1' '5s/0.1/-0.1/'
wrong 'three values for four bands' 5 'albedo: 3 values; allowed are 4' '5s/, 0.4//'
wrong 'five values' 5 'more than 4 values; allowed are 4' '5s/$/, .5/'
wrong 'trailing comma' 5 'more than 4 values' '5s/$/,/'
wrong 'empty item' 5 'albedo = *: allowed is a number' '5s/0.2//'
wrong 'two bands' 7 '2 values; allowed are 3 or 4' '7s/,[^,]*,[^,]*$//'
wrong 'five bands' 7 'more than 4 values; allowed are 3 or 4' '7s/$/, 700/'
wrong 'blanks for commas' 7 'values' '7s/,//g'
wrong 'descending wavelengths' 7 'ascending' '7s/600/500/'
wrong 'equal wavelengths' 7 'ascending' '7s/600/520.5/'
wrong 'wavelength out of range' 7 'from 200 to 3000' '7s/440/44/'
wrong 'negative irradiance' 8 'from 0 to 1000000' '8s/1,/-1,/'
wrong 'negative coefficient' 10 'from 0 to 10000' '10s/0.0331/-0.0331/'
wrong 'unknown profile' 11 'allowed is exponential, us76 or table' '11s/=.*/= tent/'
wrong 'unknown aerosol profile' 16 'exponential, exponential-background or table' '16s/=.*/= us76/'
wrong 'unknown ozone profile' 22 'tent, lognormal or table' '22s/=.*/= exponential/'
wrong 'no scale height' 12 'from 0.001 to 1000' '12s/8/0/'
wrong 'unknown phase' 18 'henyey-greenstein or cornette-shanks' '18s/=.*/= mie/'
wrong 'g of 1' 19 'from -0.9999 to 0.9999' '19s/0.8/1/'
wrong 'extinction below scattering' 15 'allowed is scattering_per_km' '15s/0.0044$/0.0039/'
wrong 'background missing' 13 'lacks background' '16s/exponential/exponential-background/'
wrong 'background over 1' 20 'from 0 to 1' -e '16s/exponential/exponential-background/' -e '19abackground = 2'
# In [dust], line 13 on, what [aerosol] has, and two more profiles.
dust='s/\[aerosol\]/[dust]/'
wrong 'dust: unknown key' 20 'unknown key h in \[dust\]; allowed are .*background, phase, g, peak_km' -e "$dust" -e '19ah = 2'
for key in 14:scattering_per_km 15:extinction_per_km 16:profile 17:scale_height_km 18:phase 19:g; do
    wrong "dust: missing ${key#*:}" 13 "lacks ${key#*:}" -e "$dust" -e "${key%%:*}s/.*/;/"
done
wrong 'dust: extinction below scattering' 15 'allowed is scattering_per_km' -e "$dust" -e '15s/0.0044$/0.0039/'
wrong 'dust: unknown profile' 16 'exponential, exponential-background, tent, lognormal or table' -e "$dust" -e '16s/=.*/= us76/'
wrong 'dust: tent without a peak' 13 'lacks peak_km' -e "$dust" -e '16s/=.*/= tent/'
wrong 'dust: half width' 18 'half_width_km = 0: allowed' -e "$dust" -e '16s/=.*/= tent/' -e '17s/.*/peak_km = 3\nhalf_width_km = 0/'
wrong 'absorption of three bands' 13 'absorption_per_km: 3 values; allowed are 4' '12s/$/\nabsorption_per_km = 1, 2, 3/'
wrong 'negative absorption' 13 'from 0 to 10000' '12s/$/\nabsorption_per_km = 0, 0, -1, 0/'
wrong 'us76 a' 12 'a = 0: allowed' -e '11s/=.*/= us76/' -e '12s/.*/a = 0/'
wrong 'us76 b' 12 'from 0.5 to 3' -e '11s/=.*/= us76/' -e '12s/.*/b = 4/'
wrong 'lognormal k' 23 'from 0.05 to 200' -e '22s/=.*/= lognormal/' -e '23s/.*/k = 0/' -e '24d'
wrong 'half width' 24 'from 0.01 to 1000' '24s/15/0/'
wrong 'unread key that is no number' 25 'from -3.4e\+38' '$amu = x'
wrong 'table missing' 9 'lacks table' -e '11s/=.*/= table/' -e '12s/.*/;/'
wrong 'table without a name' 12 'name of a file' -e '11s/=.*/= table/' -e '12s/.*/table =/'
printf '[planet]\nradius_km = 6\0360\n' >nul.ini
refuses 'NUL byte' 2 '^nul\.ini:2: binary data' q.csv eval_file nul.ini
head -c 3000 /dev/urandom >noise.ini
refuses 'noise' 2 '^noise\.ini:[0-9]+: ' q.csv eval_file noise.ini
{ cat air.ini && head -c 70000 /dev/zero | tr '\0' 'x'; } >long.ini
refuses 'enormous line' 2 '^long\.ini:25: the line is too long' q.csv eval_file long.ini
: >empty.ini
refuses 'empty file' 2 '^empty\.ini:1: section \[planet\] is missing' q.csv eval_file empty.ini
refuses 'folder' 2 '^\.: cannot be read' q.csv eval_file .
refuses 'no such file' 2 '^none\.ini: cannot be read' q.csv eval_file none.ini

# --- what is accepted ---
right 'CRLF' 's/$/\r/'
right 'no newline at the end' -z 's/\n$//'
right 'byte order mark' '1s/^/\xef\xbb\xbf/'
right 'comments' -e '3s/$/ ; the Earth/' -e '4s/^/# x\n/' -e '5s/^/   ; y\n\n/'
right 'comment of 3000 bytes' "1s/.*/; $(printf 'x%.0s' {1..3000})/"
right 'inline comment of 3000 bytes' "3s/\$/ ; $(printf 'x%.0s' {1..3000})/"
right 'list of 3000 bytes' "5s/, /,$(printf ' %.0s' {1..1000})/g"
right 'digits without end' "3s/6360/6360.$(printf '0%.0s' {1..3000})/"
right 'indented keys' 's/^\([a-z]\)/   \1/'
right 'continued list' '5s/0.3/\n    0.3/'
right 'colons' 's/ = / : /'
right 'blanks' -e 's/ = /=/' -e 's/, /,/g' -e 's/$/  \t/'
right 'other number forms' -e '3s/6360/+6.36e3/' -e '4s/60/60./' -e '5s/0\./\./g'
right 'other order of sections' -n -e '1,5{H;d}' -e 'p' -e '${x;s/^\n//;p}'
right 'dust for aerosol' "$dust"
right 'a gas that absorbs nothing' '12s/$/\nabsorption_per_km = 0, 0, 0, 0/'
for profile in 'tent\npeak_km = 3\nhalf_width_km = 1' 'lognormal\nmu = 1.2\nk = 20' 'lognormal'; do
    edited -e "$dust" -e "16s/=.*/= $profile/" -e '17d'
    does "dust: ${profile%%\\*}" q.csv eval_file edited.ini
done
edited -e '13,$d'
does 'Rayleigh alone' q.csv eval_file edited.ini
same 'three columns fewer species, same header' "$(head -n 1 stdout)" \
    'altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg,L_440,L_520.5,L_600,L_680'
edited -e 's/^\([a-z_]* = [^,]*,[^,]*,[^,]*\),.*/\1/'
does 'three bands' q.csv eval_file edited.ini
same 'three bands: header' "$(head -n 1 stdout)" \
    'altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg,L_440,L_520.5,L_600'
# The samples' places depend on all bands a little: equal to five digits, not to the bit.
same 'three bands: values' "$(tail -n 1 stdout | awk -F, '{printf "%.5g %.5g %.5g", $5, $6, $7}')" \
    "$(echo "$base" | awk -F, '{printf "%.5g %.5g %.5g", $5, $6, $7}')"
edited -e '11s/=.*/= us76/' -e '12d'
does 'us76 with defaults' q.csv eval_file edited.ini
us76=$(tail -n 1 stdout)
edited -e '11s/=.*/= us76/' -e '12s/.*/a = .07771971\nb = 1.16364243/'
does 'us76 with the defaults given' q.csv eval_file edited.ini
same 'us76 defaults' "$(tail -n 1 stdout)" "$us76"
edited -e '22s/=.*/= lognormal/' -e '23,24d'
does 'lognormal with defaults' q.csv eval_file edited.ini
lognormal=$(tail -n 1 stdout)
edited -e '22s/=.*/= lognormal/' -e '23s/.*/mu = 3.22261/' -e '24s/.*/k = 5.55555555/'
does 'lognormal with the defaults given' q.csv eval_file edited.ini
same 'lognormal defaults' "$(tail -n 1 stdout)" "$lognormal"
edited '16s/exponential/exponential-background/;17s/$/\nbackground = 0/'
does 'background 0' q.csv eval_file edited.ini
same 'background 0 is none' "$(tail -n 1 stdout)" "$base"
edited '12s/$/\na = 1/'
run q.csv eval_file edited.ini
same 'unread key: status, line, answer' "$status $(cat stderr) $(tail -n 1 stdout)" \
    "0 edited.ini:13: note: a is not read with this profile $base"

# --- tables: relative to the ini file ---
mkdir -p deep/er
awk 'BEGIN{print "altitude_km,relative_density"; for(h=0;h<=60;h+=.25) print h "," exp(-h/8)}' >deep/er/rho.csv
sed -e '11s/=.*/= table/' -e '12s:.*:table = er/rho.csv:' air.ini >deep/tab.ini
does 'table' q.csv eval_file deep/tab.ini
# Linear between rows 1/4 km apart the table is up to (.25/8)^2/8 = 1.2e-4 too dense; near enough to tell the wrong file.
cases=$((cases + 1))
paste -d, <(tail -n 1 stdout) <(echo "$base") | awk -F, '{for(i=5;i<=8;i++){d=$i/$(i+8)-1; if(d<0)d=-d; if(!(d<5e-3)){print "FAILED table: band " i-4 ": got " $i ", want " $(i+8) " +- .5 %"; exit 1}}}' || bad=$((bad + 1))
table=$(tail -n 1 stdout)
sed -e '11s/=.*/= table/' -e "12s:.*:table = $work/deep/er/rho.csv:" air.ini >abs.ini
does 'table by its whole name' q.csv eval_file abs.ini
same 'table by its whole name: answer' "$(tail -n 1 stdout)" "$table"
long=$(printf 'd%.0s' {1..150})/$(printf 'e%.0s' {1..150})
mkdir -p "$long" && cp deep/er/rho.csv "$long/"
sed -e '11s/=.*/= table/' -e "12s:.*:table = $long/rho.csv:" air.ini >longname.ini
does 'table with a name of 310 bytes' q.csv eval_file longname.ini
same 'table with a long name: answer' "$(tail -n 1 stdout)" "$table"
sed -e 's/$/\r/' -e '1s/.*/# made by awk/' deep/er/rho.csv >deep/er/plain.csv
sed -i 's:er/rho:er/plain:' deep/tab.ini
does 'table without a header, with a comment and CRLF' q.csv eval_file deep/tab.ini
same 'table without a header: answer' "$(tail -n 1 stdout)" "$table"
awk -F, 'NR==1{print "relative_density,altitude_km";next}{print $2 "," $1}' deep/er/rho.csv >deep/er/plain.csv
does 'table with swapped columns' q.csv eval_file deep/tab.ini
same 'table with swapped columns: answer' "$(tail -n 1 stdout)" "$table"
# table_wrong CASE LINE PATTERN TEXT
table_wrong() {
    printf "$4" >deep/er/plain.csv
    refuses "table: $1" 2 "^deep/er/plain\.csv:$2: .*($3)" q.csv eval_file deep/tab.ini
}
head='altitude_km,relative_density\n'
table_wrong 'empty' '[01]' '0 rows; allowed are 2 to 512' ''
table_wrong 'one row' 3 '1 rows; allowed are 2 to 512' "${head}0,1\n"
table_wrong 'unknown header' 1 'two numbers' 'h,rho\n0,1\n1,1\n'
table_wrong 'three columns' 2 'two numbers' "${head}0,1,2\n1,1\n"
table_wrong 'not ascending' 3 'more than in the row before' "${head}1,1\n1,.5\n"
table_wrong 'no number' 3 'two numbers' "${head}0,1\n1,nan\n"
table_wrong 'negative' 3 'relative_density: allowed is 0 to 1e6' "${head}0,1\n1,-1\n"
table_wrong 'altitude' 3 'altitude_km: allowed is -1000 to 1e6' "${head}0,1\n1e7,1\n"
table_wrong 'binary' 2 'binary data' "${head}\001,1\n"
table_wrong 'too many rows' 514 'too many rows' "$(awk 'BEGIN{for(i=0;i<514;i++) printf "%d,1\\n", i}' | sed 's/^/# x\\n/' | cut -c1-9000)"
sed -i 's:er/plain:er/none:' deep/tab.ini
refuses 'table: no such file' 2 '^deep/er/none\.csv: cannot be read' q.csv eval_file deep/tab.ini
sed -i 's:er/none.csv:er:' deep/tab.ini
refuses 'table: folder' 2 '^deep/er: cannot be read' q.csv eval_file deep/tab.ini
finish
