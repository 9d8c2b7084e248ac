float sample(float x) { return expf(x); }
