// Must be refused: recursion has no bound.
int skv_radiance(int n);
int skv_radiance(int n) {
    return n == 0 ? 0 : 1 + skv_radiance(n - 1);
}
