// Must be refused: 7000 bytes of stack, two calls down.
void use(volatile char *);
static __attribute__((noinline)) void inner(void) {
    volatile char buffer[7000];
    use(buffer);
}
void skv_radiance(void);
void skv_radiance(void) {
    inner();
    use(0);
}
