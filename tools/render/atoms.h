/*
 * atoms.h - colours of atoms and bonds by their labels
 *
 *   ATOM = chain:residue:name:atom[:element]     BOND = ATOM--ATOM
 *
 * Without an element it is the first letter of the atom's name; digits and quotes
 * before it do not count.
 */
#ifndef CYLINT_ATOMS_H
#define CYLINT_ATOMS_H

#include "text.h"

/* Writes the colour of the element, 0xrrggbb; that of a bond is grey.  Returns 0 if
 * the text is no label of an atom or bond. */
int colour_of_element(struct string label, uint32_t *colour);

/* Writes the number of the chain of an atom or a bond's first atom: A is 0, B is 1.
 * Returns 0 likewise. */
int number_of_chain(struct string label, size_t *number);

#endif
