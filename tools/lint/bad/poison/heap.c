float *sample(unsigned n) { return malloc(n); }
