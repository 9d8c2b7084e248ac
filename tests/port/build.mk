# Tests of the ports: each folder adds its own.
include $(sort $(wildcard tests/port/*/build.mk))
