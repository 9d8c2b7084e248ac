float sample(float x) { return x * 0.5; }
