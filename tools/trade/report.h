/// What the reports share.
#ifndef TOOLS_TRADE_REPORT_H
#define TOOLS_TRADE_REPORT_H

#include "trade.h"

#define TRADE_NUMBER 24

/// A percentage of two digits or so: "12", "1.2", ".12", ".003"; "-" where the value is negative. @return text
char *trade_percent(double fraction, char text[TRADE_NUMBER]);
/// A whole number; "-" where it is negative. @return text
char *trade_whole(double value, char text[TRADE_NUMBER]);

/// Heads of nine columns, heights over suns; the first line's indent is written already, the second's is given.
void trade_print_scenes(FILE *out, int indent, int width);

/// The atmosphere file that `skyvert eval` gives a row's answers with. @return text
char *trade_row_ini(const trade *t, const trade_row *row, char text[400]);

#endif
