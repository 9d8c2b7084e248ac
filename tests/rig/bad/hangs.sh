# seconds: 3
sleep 100 &
sleep 50
