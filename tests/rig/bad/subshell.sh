# A failure in a subshell does not get lost.
x=$(host gpio 9 9)
echo "goes on: $x"
