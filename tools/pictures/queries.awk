# The right half of a fisheye with the sun at the top: -v side=PIXELS -v sun=ZENITH_DEG -v height=KM.
BEGIN {
    print "altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg"
    for (y = 0; y < side; y++)
        for (x = side / 2; x < side; x++) {
            u = (x + .5) / (side / 2) - 1
            v = 1 - (y + .5) / (side / 2)
            r = sqrt(u * u + v * v)
            if (r <= 1) printf "%s,%s,%.5f,%.5f\n", height, sun, 90 * r, atan2(u, v) * 57.29577951308232
        }
}
