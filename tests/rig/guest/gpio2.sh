# seconds: 120
# takes: 25
# The test gpio with libgpiod 2.
panel=panel2-san
. /tests/gpio.sh
