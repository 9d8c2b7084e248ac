// Must be refused: a null pointer is followed.
float sample(const float *p);
float sample(const float *p) {
    if (p != 0)
        return 0.0f;
    return *p;
}
