poweroff -f
sleep 10
