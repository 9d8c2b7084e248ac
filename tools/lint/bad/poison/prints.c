void sample(void) { printf("x"); }
