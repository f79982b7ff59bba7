/*
 * main.h - the command's name and exit status, and its machine
 */
#ifndef CYLINT_MAIN_H
#define CYLINT_MAIN_H

extern const char *const program; /* the name of the program, in messages */

enum {
    EXIT_ANSWERED = 0, /* all records; a miss is an answer */
    EXIT_BAD = 1,      /* some records are bad, or a line of the scene */
    EXIT_USAGE = 2,
    EXIT_IO = 3, /* input or output failed */
    EXIT_MEMORY = 4
};

/* The number of processors that this process may use; at least 1. */
int processors(void);

#endif
