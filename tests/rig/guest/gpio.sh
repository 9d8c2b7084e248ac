# seconds: 120
# takes: 25
panel=${panel:-panel-san}
# A panel with the sanitizers: encoder turned, button bounced, toggle, lamps; then lines that are busy, missing, out of range.
mkfifo in
# shellcheck disable=SC2094
$panel encoder_a=ENC_A encoder_b=ENC_B button=BUTTON toggle=gpiochip0:4 lamp_night=LAMP_NIGHT lamp_bus=0:6 \
    active_low=button,lamp_bus debounce_ms=400 <in >panel.log 2>&1 &
pid=$!
host gpio 2 1 # the button is to ground: not pressed
exec 8>in
wait_for 20 has panel.log ready || fail "the panel does not start: $(cat panel.log)"
grep -q gpio: panel.log && fail "a line was refused"
asked() {
    echo steps >&8
    has panel.log "^position $1"
}
ask() { wait_for 10 asked "$1" || fail "wanted position $1: $(tail -n 3 panel.log)"; }

# 40 quarter steps of 4 ms forwards are 10 clicks, then 20 backwards: 5 clicks. The kernel's stamps keep the edges in order.
host turn 0 1 40 4 >/dev/null
ask "40 invalid 0 "
host turn 0 1 -20 4 >/dev/null
ask "20 invalid 0 "
forwards=$(awk '$1 == "clicks" && $2 > 0 {n += $2} END {print n + 0}' panel.log)
backwards=$(awk '$1 == "clicks" && $2 < 0 {n -= $2} END {print n + 0}' panel.log)
[ "$forwards $backwards" = "10 5" ] || fail "clicks: $forwards forwards, $backwards backwards, want 10 and 5"

# Three presses of a button that bounces for 8 ms at each end; 400 ms to settle, for a board that gets little of a busy machine.
for press in 1 2 3; do
    host wave 0:2:0 2:2:1 4:2:0 6:2:1 8:2:0 >/dev/null
    usleep 900000
    host wave 0:2:1 3:2:0 5:2:1 7:2:0 8:2:1 >/dev/null
    usleep 900000
done
presses=$(awk '$1 == "presses" {n += $2} END {print n + 0}' panel.log)
[ "$presses" = 3 ] || fail "$presses presses counted, 3 made"
[ "$(grep -c 'button down' panel.log) $(grep -c 'button up' panel.log)" = "3 3" ] || fail "the button's state: $(grep button panel.log)"
ask "20 invalid 0 bounces 24 "
# A spike is no press.
host wave 0:2:0 5:2:1 >/dev/null
usleep 900000
presses=$(awk '$1 == "presses" {n += $2} END {print n + 0}' panel.log)
[ "$presses" = 3 ] || fail "a spike of 5 ms was taken for a press"

host gpio 4 1
wait_for 5 has panel.log "toggle 1" || fail "the toggle switched on was not seen"
host gpio 4 0
wait_for 5 has panel.log "toggle 0" || fail "the toggle switched off was not seen"

# Lamps; the second is active low.
[ "$(host outputs)" = "5=0 6=1" ] || [ "$(host outputs)" = "6=1" ] || fail "lamps at the start: $(host outputs)"
echo "night 1" >&8
host await 5 1 5 >/dev/null
echo "bus 1" >&8
host await 6 0 5 >/dev/null
echo "night 0" >&8
host await 5 0 5 >/dev/null

# The same lines once more: each is reported, by name or by offset, and what is left works.
echo end | $panel encoder_a=ENC_A encoder_b=ENC_B button=2 toggle=gpiochip0:8 lamp_night=0:5 lamp_bus=gpiochip9:0 >refused.log 2>&1 ||
    fail "a panel without lines: status $?: $(cat refused.log)"
expect() { grep -qF -- "$1" refused.log || fail "not said: '$1': $(cat refused.log)"; }
expect "gpio: encoder (ENC_A, ENC_B): busy: in use by skyvert; goes on without it"
expect "gpio: button (2): no such line on 1 GPIO chip; goes on without it"
expect "gpio: toggle (gpiochip0:8): gpiochip0 has the lines 0 to 7; goes on without it"
expect "gpio: lamp_night (0:5): busy: in use by skyvert; goes on without it"
expect "gpio: lamp_bus (gpiochip9:0): /dev/gpiochip9: No such file or directory; goes on without it"
[ "$(grep -c '^gpio: ' refused.log)" = 5 ] || fail "one line each: $(cat refused.log)"
echo end | $panel encoder_a=SPARE encoder_b=0:7 button=gpiochip0:7 toggle=gpiochip0:7 >refused.log 2>&1 || fail "a line for two uses: status $?: $(cat refused.log)"
expect "both are line 7 of /dev/gpiochip0"
expect "this line is button already"
$panel debounce_ms=fast >bad.log 2>&1
[ $? = 2 ] || fail "debounce_ms=fast was taken"

# The end: lamps out, lines given back.
echo end >&8
exec 8>&-
wait $pid || fail "the panel's exit status: $?, $(tail -n 5 panel.log)"
[ "$(host outputs)" = "5=0 6=1" ] || fail "lamps at the end: $(host outputs)"
gpioinfo gpiochip0 | grep -q skyvert && fail "a line was not given back"
note "gpio, $panel: encoder 60 quarter steps, 3 bounced presses, toggle, 2 lamps, 5 refused lines as they should be"
