// Must be refused: a fused multiply-add (the gate builds this with contraction on).
// Says: vfmadd|vfma
float sample(float a, float b, float c);
float sample(float a, float b, float c) { return a * b + c; }
