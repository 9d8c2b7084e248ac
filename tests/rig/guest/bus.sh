# takes: 8
# The rig's own means: both controllers on one bus, an adapter that goes bus-off, error frames, a pulled cable.
can_up
candump -t a -n 2 can1 >got &
pid=$!
listens can1
cansend can0 123#1122334455667788
wait_for 5 has got "123 *\[8\] *11 22 33 44 55 66 77 88" || fail "no frame on can1: $(cat got)"
stop $pid

# The cable: while can1 is down its reader gets nothing, and afterwards it does again.
cable_out can1
cansend can0 124#00 || fail "can0 does not send alone"
cable_in can1
candump -n 1 can1 >again &
listens can1
cansend can0 125#01
wait_for 5 has again "125 *\[1\] *01" || fail "no frame after the cable was put back: $(cat again)"

slcan_start
candump -e "slcan0,0:0,#FFFFFFFF" >slcan.log 2>&1 &
listens slcan0
slcan t32130102FF
wait_for 5 has slcan.log "321 *\[3\] *01 02 FF" || fail "the adapter's frame: $(cat slcan.log)"
cansend slcan0 456#DEAD
wait_for 5 has adapter.log "^sent t4562DEAD" || fail "the frame to the adapter: $(cat adapter.log)"
slcan sb256000
wait_for 5 slcan_state BUS-OFF || fail "no bus-off: $(ip -details link show slcan0)"
wait_for 5 has slcan.log "ERRORFRAME" || fail "no error frame: $(cat slcan.log)"
slcan_restart
wait_for 5 slcan_state ERROR-ACTIVE || fail "no way back: $(ip -details link show slcan0)"
candump slcan0 >back.log 2>&1 & # the first one ended with "Network is down"
listens slcan0
slcan t32110A
wait_for 5 has back.log "321 *\[1\] *0A" || fail "no frame after bus-off: $(cat back.log)"

vcan_up
candump -e "vcan0,0:0,#FFFFFFFF" >vcan.log 2>&1 &
listens vcan0
bus_off_frame vcan0
wait_for 5 has vcan.log "bus-off" || fail "no bus-off frame on vcan0: $(cat vcan.log)"
figure "board: free memory $(awk '/MemAvailable/ {print $2}' /proc/meminfo) kB"
