// Must be refused: a read past the end.
float sample(void);
float sample(void) {
    const float three[3] = {0.0f, 1.0f, 2.0f};
    return three[3];
}
