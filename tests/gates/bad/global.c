// Must be refused: a global that can be written.
// Says: writable data: sample_count
int sample_count = 1;
