# The README is compiled, run and checked for names that are not there.
TEST_SCRIPT += tests/readme/readme.sh
