# seconds: 110
# takes: 45
# skyvert-cockpit with the sanitizers while the bus fails: cable pulled, bus-off of an adapter, an error frame, the interface removed, a
# log by canplayer. None of it ends it, and each is shown.
last() { tail -n 1 lines; }
says() { last | grep -q "$1"; }
stat() { awk -v w="$1" '$1 == w {print $2}' stats; }
begin() { # INTERFACE
    skyvert-cockpit-san --interface "$1" --rate 10 --vertices 64 --shm sky --stats stats >lines 2>said &
    pid=$!
    listens "$1"
}
end() {
    kill -TERM $pid
    wait $pid || fail "$1: status $?: $(cat said)"
    [ -s said ] && fail "$1: it said: $(cat said)"
    true
}
printf 'utc,lat_deg,lon_deg,height_m\n2024-03-20T12:00:00Z,47,8.5,1000\n2024-03-20T13:00:00Z,48,8.5,1000\n' >flight.csv

# The cable.
can_up
begin can1
skyvert-sim flight.csv --interface can0 2>sim.said &
sender=$!
wait_for 15 says "^live .* lamps .0 .*bus \"up, 500 kbit/s\"" || fail "live: $(cat lines said)"
cable_out can1
wait_for 10 says "^held .* lamps .1 .*bus \"down\"" || fail "cable out: $(last)"
cable_in can1
wait_for 15 says "^live .* lamps .0 .*bus \"up, 500 kbit/s\" stale \"\"" || fail "cable in: $(last)"
stop $sender

# A recorded log by canplayer.
skyvert-sim flight.csv --start 600 --duration 30 --log flight.log 2>sim.said || fail "log: $(cat sim.said)"
wait_for 15 says "^held" || fail "the sender is gone: $(last)"
canplayer -I flight.log can0=can0 &
player=$!
wait_for 10 says "^live .* utc 2024-03-20T12:1.* lamps .0" || fail "canplayer: $(last)"
stop $player

end "canplayer"
can_down

# Bus-off: an adapter's controller. It says so until the interface is taken down and up.
slcan_start
begin slcan0
slcan t70887F020000432A0000 # nonsense of the right id does no harm
slcan t70980102000041A00000
wait_for 15 says "bus \"up" || fail "the adapter: $(cat lines said)"
slcan sb256000
wait_for 10 says "lamps .1 .*bus-off" || fail "bus-off: $(last)"
slcan_restart
recovered() { last | grep -q "bus \"up" && ! last | grep -q "bus-off"; }
wait_for 10 recovered || fail "after bus-off: $(last)"
end "adapter"
[ "$(stat bus_offs)" -ge 1 ] || fail "bus-offs counted: $(stat bus_offs)"

# An injected error frame between good ones: the lamp for a second. Then the interface is removed and comes back.
vcan_up
begin vcan0
skyvert-sim flight.csv --interface vcan0 2>sim.said &
sender=$!
wait_for 15 says "^live .* lamps .0" || fail "vcan0: $(cat lines said)"
vertices /sky 3 >frames &
reader=$!
bus_off_frame vcan0
wait $reader
awk '{if (int($6 / 16) % 2) lit++} END {exit !(lit >= 3 && lit <= 25)}' frames || fail "lamp by an error frame: $(cat frames)"
wait_for 5 says "^live .* lamps .0" || fail "after the error frame: $(last)"
stop $sender
ip link del vcan0
wait_for 10 says "lamps .1 .*the interface is gone" || fail "interface removed: $(last)"
vcan_up
wait_for 10 says "bus \"up\"" || fail "interface back: $(last)"
skyvert-sim flight.csv --interface vcan0 2>sim.said &
sender=$!
wait_for 15 says "^live .* lamps .0" || fail "on the new interface: $(last)"
stop $sender
end "interface removed"

skyvert-cockpit-san --interface can7 >lines 2>said
[ $? = 2 ] && [ "$(grep -c . said)" = 1 ] && grep -q can7 said || fail "an interface that is none: $(cat said)"
