float sample(float x) { return (float)((double)x); }
