# seconds: 120
# takes: 35
# Switches and lamps of skyvert-cockpit: the knob turned, the button bounced, the toggle; the night lighting at
# the right elevation of the sun; lines that are missing or busy.
word() { awk -v w="$2" '{for (i = 1; i < NF; i++) if ($i == w) v = $(i + 1)} END {print v}' "$1"; }
last() { tail -n 1 lines; }
says() { last | grep -q "$1"; }
is() { awk -v a="$1" -v b="$3" "BEGIN {exit !(a $2 b)}"; }
printf 'utc,lat_deg,lon_deg,height_m\n2024-03-20T17:00:00Z,47,8.5,1000\n2024-03-20T18:00:00Z,47,8.5,1000\n' >stands.csv
cat >panel.ini <<END
[can]
interface = can1
[knobs]
minutes_per_click = 10
[gpio]
encoder_a = ENC_A
encoder_b = ENC_B
button = BUTTON
toggle = gpiochip0:4
lamp_night = LAMP_NIGHT
lamp_bus = 0:6
active_low = button
debounce_ms = 200
END
host gpio 2 1 # the button is to ground: not pressed
host gpio 4 0
can_up
skyvert-cockpit --config panel.ini --rate 15 --vertices 64 --shm sky >lines 2>said &
pid=$!
listens can1
# At 47 N 8.5 E the sun passes -.833 deg at 17:39:08 UTC (skyvert sun, itself checked against ERFA). A minute in six seconds.
skyvert-sim stands.csv --start 2024-03-20T17:37:40Z --speed 10 --interface can0 2>sim.said &
sender=$!
wait_for 15 says "^live .* lamps 0" || fail "live: $(cat lines said)"
vertices /sky 14 >frames &
reader=$!
host await 5 1 20 >/dev/null || fail "the night lamp: $(tail -n 3 lines)"
wait_for 5 says "lamps 1" || fail "its word: $(last)"
wait $reader || fail "the shared memory: status $?"
lit=$(awk '{if (int($6 / 32) % 2) {print $9; exit}}' frames)
dark=$(awk '{if (!(int($6 / 32) % 2)) d = $9} END {print d}' frames)
figure "cockpit on the board: night lighting lit at $lit deg, dark until $dark deg, set -0.833"
# It turns a .0028 deg in .1 s (ten times as fast); frames are up to a second apart on a board that is late.
is "$lit" "<=" -0.833 && is "$lit" ">" -0.87 || fail "lit at $lit deg"
is "$dark" ">" -0.8333 && is "$dark" "<" -0.79 || fail "dark until $dark deg"
host outputs | grep -q 6=1 && fail "the bus lamp is lit: $(last)"

# Three clicks back are half an hour: the sun is up again, and the lamp goes out above its hysteresis.
host turn 0 1 -12 5 >/dev/null
wait_for 10 says "offset -1800 " || fail "three clicks back: $(last)"
host await 5 0 10 >/dev/null || fail "the lamp by day: $(last)"
host turn 0 1 4 5 >/dev/null
wait_for 10 says "offset -1200 " || fail "one click on: $(last)"
# The toggle gives the knob to the visibility; the air is built anew meanwhile (`air` follows in a minute on this board).
host gpio 4 1
usleep 600000
host turn 0 1 -8 5 >/dev/null
wait_for 10 says "visibility 25.60 .*offset -1200 " || fail "visibility two clicks down of 40 km: $(last)"
# The button bounces, and takes both back.
host wave 0:2:0 3:2:1 6:2:0 9:2:1 12:2:0 >/dev/null
usleep 600000
host wave 0:2:1 3:2:0 6:2:1 >/dev/null
wait_for 10 says "offset 0 " || fail "the button: $(last)"
wait_for 10 says "visibility 40.00 " || fail "the button takes the visibility back: $(last)"

# A second cockpit finds the lines busy, and some that no chip has: a line each, and it runs on.
sed -e 's/BUTTON/NO_SUCH_LINE/' -e 's/0:6/0:99/' panel.ini >other.ini
skyvert-cockpit --config other.ini --rate 5 --vertices 64 --duration 3 >other 2>refused || fail "a second one: status $?: $(cat refused)"
grep -q "^live" other || fail "a second one: $(cat other)"
for text in "encoder (ENC_A, ENC_B): busy" "button (NO_SUCH_LINE): no such line" "toggle (gpiochip0:4): busy" "lamp_night (LAMP_NIGHT): busy" "lamp_bus (0:99): gpiochip0 has the lines 0 to 7"; do
    grep -qF "$text" refused || fail "not said: $text: $(cat refused)"
done
[ "$(grep -c . refused)" = 5 ] || fail "a line each: $(cat refused)"

# The sender ends: the bus lamp.
stop $sender
host await 6 1 10 >/dev/null || fail "no bus lamp: $(last)"
kill -TERM $pid
wait $pid || fail "ended: status $?: $(cat said)"
[ -s said ] && fail "it said: $(cat said)"
[ "$(host outputs)" = "5=0 6=0" ] || fail "lamps at the end: $(host outputs)"
