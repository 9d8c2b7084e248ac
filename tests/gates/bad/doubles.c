// Must be refused: arithmetic in double, by a constant without f.
// Says: cvtss2sd|needs __aeabi_(f2d|dmul)
float sample(float x);
float sample(float x) { return (float)(x * 1.1); }
