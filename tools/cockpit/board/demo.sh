# seconds: 600
# make demo-cockpit on the board: a flight into the dusk, twenty times as fast; the knob is turned and the button pressed from outside.
cat >panel.ini <<END
[can]
interface = can1
[gpio]
encoder_a = ENC_A
encoder_b = ENC_B
button = BUTTON
toggle = TOGGLE
lamp_night = LAMP_NIGHT
lamp_bus = LAMP_BUS
active_low = button
END
host gpio 2 1
host gpio 4 0
can_up
skyvert-cockpit --config panel.ini --terminal --rate 10 --vertices 512 --duration "$(cat /files/seconds)" &
pid=$!
skyvert-sim /files/flight.csv --start 2024-03-20T17:10:00Z --speed 20 --loop --interface can0 2>/dev/null &
sleep 20
host turn 0 1 -12 20 >/dev/null # half an hour back
sleep 8
host wave 0:2:0 40:2:1 >/dev/null
sleep 3
cable_out can0
sleep 5
cable_in can0
wait $pid
