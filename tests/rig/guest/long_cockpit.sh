# seconds: 700
# Ten minutes at real rates: not one frame lost, memory does not grow; what was shown, summed up.
awk 'BEGIN {print "utc,lat_deg,lon_deg,height_m"
            for (m = 0; m < 60; m++) printf "2024-03-20T17:%02d:00Z,%.7f,8.5,%d\n", m, 47 + m * .12, 1000 + 100 * m}' >north.csv
stat() { awk -v w="$1" '$1 == w {print $2}' stats; }
can_up
skyvert-cockpit --interface can1 --rate 20 --vertices 256 --shm sky --stats stats --duration ${cockpit_seconds:-605} >lines 2>said &
pid=$!
listens can1
skyvert-sim north.csv --interface can0 2>sim.said &
sender=$!
wait $pid || fail "status $?: $(cat said)"
kill -TERM $sender
wait $sender || fail "skyvert-sim: status $?: $(cat sim.said)"
[ -s said ] && fail "it said: $(cat said)"
for name in can_missing can_duplicate can_out_of_order can_out_of_range can_wrong_type can_wrong_length can_other_node can_went_stale dropped frames_refused; do
    [ "$(stat $name)" = 0 ] || fail "$name: $(stat $name)"
done
# UTC and date once a second, latitude, longitude and two heights ten times
[ "$(stat can_accepted)" -gt $((${cockpit_seconds:-605} * 38)) ] || fail "accepted: $(stat can_accepted)"
[ "$(stat memory)" -le $(($(stat memory_early) + 400)) ] || fail "memory grew from $(stat memory_early) to $(stat memory) KB"
[ "$(grep -c '^live' lines)" -ge $((${cockpit_seconds:-605} * 9 / 10)) ] || fail "live lines: $(grep -c '^live' lines)"
figure "cockpit on the board, $(stat run) s: $(stat can_accepted) frames accepted, $(stat can_missing) missing, $(stat dropped) dropped, $(stat can_went_stale) stale"
figure "cockpit on the board: $(stat frames) skies of 256 vertices, $(stat frames_late) late; received to published $(stat latency_median) ms median, $(stat latency_p99) ms 99 of 100"
figure "cockpit on the board: memory $(stat memory_early) KB after 3 s, $(stat memory) KB at the end; processor $(stat processor) %"
note "$(tail -n 1 sim.said)"
