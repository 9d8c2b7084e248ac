# seconds: 120
# skyvert-sim on can0, skyvert-cockpit on can1: 22 s at real rates without one frame lost; the receiver started before the sender
# and after it; identification; the sender killed and started again; every value stale.
awk 'BEGIN {print "utc,lat_deg,lon_deg,height_m"
            for (m = 0; m < 60; m++) printf "2024-03-20T16:%02d:00Z,%.7f,8.5,%d\n", m, 47 + m * .12, 1000 + 100 * m}' >north.csv
# its latitude grows by .002 degrees a second, from 47 at 16:00:00
word() { awk -v w="$2" '{for (i = 1; i < NF; i++) if ($i == w) v = $(i + 1)} END {print v}' "$1"; }
stat() { awk -v w="$1" '$1 == w {print $2}' stats; }
last() { tail -n 1 lines; }
stat_line() { word lines "$1"; }
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
candump -L can1,081:7FF >answers 2>/dev/null &
sleep 2 # until it listens: the cockpit does so already
for n in 1 2 3; do
    cansend can0 080#0000000$n
    usleep 200000
done
sleep 20
[ "$(grep -c '081#14' answers)" = 3 ] || fail "three identification requests: $(cat answers)"

# Not one frame is lost or misread. (Later the sender is killed: then message codes are missing.)
accepted=$(stat_line received)
[ "$(stat_line missing) $(stat_line duplicate) $(stat_line refused) $(stat_line dropped)" = "0 0 0 0" ] || fail "lost or misread: $(last)"
[ "$accepted" -gt 760 ] || fail "received in 20 s: $accepted" # 38 a second
figure "cockpit on the board: $accepted frames received at real rates, none lost or misread"

# Where it shows the aircraft is where the flight is at the time it shows, in metres ahead. UTC comes in whole seconds: a sender
# that began late on a busy board says them late for ever, by up to a second (222 m). But it stays the same for all lines.
awk '$1 == "live" {split(substr($6, 12), t, ":"); s = 60 * t[2] + t[3]; if (n++ > 4) print ($8 - 47 - s * .002) * 111200}' lines |
    sort -n | awk '{e[NR] = $1} END {print e[int((NR + 1) / 2)], e[NR] - e[1], NR}' >place
read -r middle spread lines <place
figure "cockpit on the board: place shown against the flight: median $middle m ahead, steady within $spread m, $lines lines (222 m/s)"
is "$middle" ">" -40 && is "$middle" "<=" 225 || fail "place shown: median $middle m ahead of the flight"
is "$spread" "<=" 45 || fail "place shown: within $spread m" # .2 s: frames and time of a board that gets little of a busy machine
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
for name in can_duplicate can_out_of_order can_out_of_range can_wrong_type can_wrong_length can_other_node dropped frames_refused; do
    [ "$(stat $name)" = 0 ] || fail "$name: $(stat $name)"
done
[ "$(stat can_accepted)" -gt 900 ] || fail "accepted: $(stat can_accepted)"
[ "$(stat can_service)" = 3 ] || fail "services: $(stat can_service)"
figure "cockpit on the board: $(stat can_accepted) frames accepted, $(stat can_missing) missing, $(stat dropped) dropped by the kernel"
figure "cockpit on the board: received to published $(stat latency_median) ms median, $(stat latency_p99) ms 99 of 100, at 20 Hz; memory $(stat memory_early) KB early, $(stat memory) KB at the end"
[ "$(stat memory)" -le $(($(stat memory_early) + 400)) ] || fail "memory grew from $(stat memory_early) to $(stat memory) KB"

# The receiver after the sender.
skyvert-cockpit --interface can1 --rate 20 --vertices 64 --duration 4 >lines 2>said || fail "after the sender: status $?: $(cat said)"
says "^live .* lamps .0" || fail "after the sender: $(cat lines)"
stop $sender
