# one.sh NAME: one test of the board, by its own shell: its processes end with it.
. /rig/lib.sh
name=$1
. /tests/"$name".sh
