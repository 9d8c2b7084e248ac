# seconds: 90
# takes: 30
# skyvert-sim on can0, skyvert-cockpit on can1: the receiver started before the sender and after it; the sender killed and started
# again; every value stale.
awk 'BEGIN {print "utc,lat_deg,lon_deg,height_m"
            for (m = 0; m < 60; m++) printf "2024-03-20T16:%02d:00Z,%.7f,8.5,%d\n", m, 47 + m * .12, 1000 + 100 * m}' >north.csv
# its latitude grows by .002 degrees a second, from 47 at 16:00:00
word() { awk -v w="$2" '{for (i = 1; i < NF; i++) if ($i == w) v = $(i + 1)} END {print v}' "$1"; }
stat() { awk -v w="$1" '$1 == w {print $2}' stats; }
last() { tail -n 1 lines; }
says() { last | grep -q "$1"; }
is() { awk -v a="$1" -v b="$3" "BEGIN {exit !(a $2 b)}"; }

can_up
skyvert-cockpit --interface can1 --rate 20 --vertices 256 --shm sky --stats stats >lines 2>said &
pid=$!
listens can1
wait_for 10 says "^waiting" || fail "before the sender: $(cat lines said)"
wait_for 10 says "lamps .1" || fail "no lamp although nothing comes: $(last)"
skyvert-sim north.csv --interface can0 2>sim.said &
sender=$!
wait_for 10 says "^live .* lamps .0" || fail "with the sender: $(cat lines said)"
vertices /sky >frame || fail "the shared memory: status $?"
[ "$(word frame vertices)" -ge 230 ] || fail "vertices: $(cat frame)"
is "$(word frame horizon)" "<" 0 || fail "horizon: $(cat frame)"

# Killed: all goes stale, the sky is held, the lamp is lit. Started again: it goes on, from where the flight is then.
kill -9 $sender
wait $sender 2>/dev/null
wait_for 15 says "^held .* lamps .1 .*stale \".*Latitude Longitude.*UTC Date" || fail "everything stale: $(tail -n 3 lines)"
before=$(last | cut -d ' ' -f 3,4)
sleep 2
[ "$(last | cut -d ' ' -f 3,4)" = "$before" ] || fail "the sky moves although nothing comes: $(tail -n 3 lines)"
vertices /sky >frame || fail "the shared memory: status $?"
[ $(($(word frame flags) & 31)) = 31 ] || fail "flags: $(cat frame)" # position, height, time, held, bus fault
skyvert-sim north.csv --start 600 --interface can0 2>>sim.said &
sender=$!
wait_for 15 says "^live .* lamps .0 .*stale \"\"" || fail "the sender is back: $(tail -n 3 lines; cat said)"
sleep 2
is "$(word lines lat)" ">" 48.19 || fail "the new place: $(last)"

kill -TERM $pid
wait $pid || fail "ended by SIGTERM: status $?: $(cat said)"
[ -s said ] && fail "it said: $(cat said)"
[ "$(stat dropped) $(stat can_wrong_type) $(stat frames_refused)" = "0 0 0" ] || fail "dropped, misread or refused: $(cat stats)"

# The receiver after the sender.
skyvert-cockpit --interface can1 --rate 20 --vertices 64 --duration 4 >lines 2>said || fail "after the sender: status $?: $(cat said)"
says "^live .* lamps .0" || fail "after the sender: $(cat lines)"
stop $sender
