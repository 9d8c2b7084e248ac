# seconds: 700
# Ten minutes at real rates.
seconds=600
. /tests/real.sh
