#!/usr/bin/env bash
# The checksums of compare.sh with the variants too that gcc needs long to build.
BITS=full exec bash "$(dirname "$0")/compare.sh"
