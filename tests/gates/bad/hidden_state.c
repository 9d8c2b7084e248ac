// Must be refused: state hidden in a function.
// Says: writable data: calls
unsigned sample(void);
unsigned sample(void) {
    static unsigned calls;
    return ++calls;
}
