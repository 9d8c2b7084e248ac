# seconds: 120
# The test gpio with libgpiod 2.
panel=panel2-san
. /tests/gpio.sh
