# seconds: 90
# takes: 35
# skyvert-sim on a real kernel, with the sanitizers: the clock set, the cable, a full queue, bus-off, the interface removed.
awk 'BEGIN {print "utc,lat_deg,lon_deg,height_m"
            for (m = 0; m < 60; m++) printf "2024-03-20T16:%02d:00Z,%.7f,8.5,%d\n", m, 47 + m * .12, 1000 + 100 * m}' >north.csv
# its latitude grows by .002 degrees a second
field() { echo "$checked" | tr ' ' '\n' | sed -n "s/^$1=//p"; }
check() { checked=$(sim-check "$1" 47 "$2") && echo "$checked" >>checked; }
at_most() { awk -v a="$(field "$1")" -v b="$2" 'BEGIN {exit !(a <= b)}' || fail "$3: $1 is $(field "$1"), allowed $2: $checked"; }
at_least() { awk -v a="$(field "$1")" -v b="$2" 'BEGIN {exit !(a >= b)}' || fail "$3: $1 is $(field "$1"), wanted $2: $checked"; }

can_up
# The clock is set an hour on; the cable is out for a while.
candump -L can1 >cable.log 2>/dev/null &
pid=$!
listens can1
skyvert-sim-san north.csv --interface can0 --speed 10 2>cable.said &
sender=$!
sleep 1.5
date -s "@$(($(date +%s) + 3600))" >/dev/null
sleep 1.5
cable_out can0
wait_for 5 has cable.said "can0: is down" || fail "the cable was not noticed: $(cat cable.said)"
sleep 1.5
cable_in can0
wait_for 5 has cable.said "can0: works again" || fail "the cable's return was not noticed: $(cat cable.said)"
sleep 1.5
kill -TERM $sender
wait $sender || fail "ended by SIGTERM: status $?: $(cat cable.said)"
grep -q "frames sent in .*, interface 1 times down, .* 1 recoveries" cable.said || fail "its summary: $(cat cable.said)"
stop $pid
check cable.log .02
at_least latitudes 25 "cable"
at_least lost 80 "cable: a second and a half of all messages"
at_most lat_ms 200 "cable: the position behind the gap"
at_most worst_lat_ms 1000 "cable: the first position behind a gap of a second and a half"

can_down
# An adapter that takes nothing for a while: the queue fills, a replay waits, and no frame is lost or out of order.
slcan_start
adapter=$!
ip link set slcan0 txqueuelen 3
awk 'BEGIN {for (i = 0; i < 2000; i++) printf "(%.6f) x %03X#%04X\n", i * .00002, 0x100 + i % 512, i}' >dense.log
sed 's/.* x \(...\)#/sent t\12/' dense.log >want
kill -STOP $adapter
skyvert-sim dense.log --interface slcan0 2>queue.said &
sender=$!
sleep 2
kill -CONT $adapter
wait $sender || fail "replay: status $?: $(cat queue.said)"
wait_for 10 has adapter.log "$(tail -n 1 want)" || fail "the end of the replay: $(tail -n 2 adapter.log)"
grep '^sent t' adapter.log | cmp - want || fail "the replay differs: $(cat queue.said)"
grep -q "2000 frames sent .*, 0 not heard back, [1-9][0-9]* waits" queue.said || fail "its summary: $(cat queue.said)"
note "$(cat queue.said)"

# Bus-off, which this adapter's driver cannot restart: it says so, and goes on when the interface was taken down and up.
skyvert-sim-san north.csv --interface slcan0 2>off.said &
sender=$!
wait_for 10 has adapter.log "^sent t40C" || fail "nothing reaches the adapter: $(cat off.said)"
slcan sb256000
wait_for 5 has off.said "slcan0: bus-off" || fail "bus-off was not noticed: $(cat off.said)"
slcan_restart
wait_for 5 has off.said "slcan0: works again" || fail "the way back was not noticed: $(cat off.said)"
before=$(grep -c "^sent t40C" adapter.log)
goes_on() { [ "$(grep -c "^sent t40C" adapter.log)" -gt $((before + 3)) ]; }
wait_for 5 goes_on || fail "nothing is sent after bus-off: $(cat off.said)"
kill -TERM $sender
wait $sender || fail "after bus-off: status $?: $(cat off.said)"
grep -q "1 bus-off" off.said || fail "its summary: $(cat off.said)"

# The interface is removed and comes back: all begins again there.
vcan_up
skyvert-sim-san north.csv --interface vcan0 2>gone.said &
sender=$!
candump -L -n 30 vcan0 >gone1.log
ip link del vcan0
wait_for 5 has gone.said "vcan0: is gone" || fail "its end was not noticed: $(cat gone.said)"
vcan_up
wait_for 5 has gone.said "vcan0: works again" || fail "its return was not noticed: $(cat gone.said)"
candump -L -n 30 vcan0 >gone2.log
[ "$(grep -c . gone2.log)" = 30 ] || fail "nothing is sent on the new interface: $(cat gone.said)"
kill -TERM $sender
wait $sender || fail "after it was gone: status $?: $(cat gone.said)"
skyvert-sim-san north.csv --interface can7 2>no.said
[ $? = 2 ] && grep -q "can7: there is no CAN interface" no.said || fail "an interface that is none: $(cat no.said)"
skyvert-sim-san north.csv --interface vcan0 --bitrate 12000 2>load.said
[ $? = 2 ] && grep -q "take.* up to .* % of a bus of 12000 bit/s" load.said || fail "too much for a bus: $(cat load.said)"
