#!/usr/bin/env bash
# Says what was not tested.
pkg-config --exists geographiclib 2>/dev/null &&
    echo "geoid: the package proj-data is not installed" ||
    echo "geographiclib: the package libgeographiclib-dev is not installed"
exit 77
