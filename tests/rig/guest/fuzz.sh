# seconds: 120
# takes: 65
# 100,000 random frames on vcan0 at skyvert-cockpit and skyvert-sim, both with the sanitizers: most of the ids that they hear, with
# good and bad headers and any data; the rest any id, length and kind (tests/can/random_frames.c).
last() { tail -n 1 lines; }
says() { last | grep -q "$1"; }
stat() { awk -v w="$1" '$1 == w {print $2}' stats; }
frames=100000
random-frames $frames 2026 250 >random.log || fail "no random frames"
vcan_up
skyvert-cockpit-san --interface vcan0 --rate 5 --vertices 64 --shm sky --stats stats >lines 2>said &
pid=$!
listens vcan0
skyvert-sim-san random.log --interface vcan0 --bitrate 1000000 2>sim.said
status=$?
[ $status = 0 ] || fail "the sender: status $status: $(cat sim.said)"
sleep 1
kill -0 $pid || fail "the cockpit ended: $(cat said)"
vertices /sky >frame
case $? in 0 | 2) ;; *) fail "the shared memory" ;; esac
grep -i nan lines frame && fail "not a number"
kill -TERM $pid
wait $pid || fail "status $?: $(cat said)"
[ -s said ] && fail "it said: $(cat said)"
note "$(tail -n 1 sim.said)"
figure "fuzz on the board: $frames random frames: $(stat received) passed the filters of the kernel, $(stat dropped) dropped by it, $(stat can_accepted) accepted, $(stat can_wrong_type) of a wrong type, $(stat can_wrong_length) of a wrong length, $(stat can_out_of_range) out of range, $(stat frames_refused) skies refused"
[ "$(stat frames_refused)" = 0 ] || fail "the core refused $(stat frames_refused) skies"
