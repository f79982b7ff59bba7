/*
 * atoms.c - colours of atoms and bonds by their labels
 *
 *   ATOM = chain:residue:name:atom[:element]     BOND = ATOM--ATOM
 *
 * Without an element it is the first letter of the atom's name; digits and quotes
 * before it do not count.
 */
#include "colours.h"

enum { FIELDS = 5, BOND = 0xb4b4b4, OTHER_ELEMENT = 0xff1493 };

/* Colours of Jmol; those of H, C, N, O and S are softer. */
static const struct {
    const char *symbol;
    uint32_t colour;
} elements[] = {
    {"H", 0xe8e8e8},  {"D", 0xe8e8e8},  {"C", 0x6b6b6b},  {"N", 0x3050f8},
    {"O", 0xe0301e},  {"S", 0xe0b020},  {"P", 0xff8000},  {"F", 0x90e050},
    {"Cl", 0x1ff01f}, {"Br", 0xa62929}, {"I", 0x940094},  {"B", 0xffb5b5},
    {"Si", 0xf0c8a0}, {"Se", 0xffa100}, {"Li", 0xcc80ff}, {"Na", 0xab5cf2},
    {"K", 0x8f40d4},  {"Mg", 0x8aff00}, {"Ca", 0x3dff00}, {"Mn", 0x9c7ac7},
    {"Fe", 0xe06633}, {"Co", 0xf090a0}, {"Ni", 0x50d050}, {"Cu", 0xc88033},
    {"Zn", 0x7d80b0}, {"Cd", 0xffd98f}, {"Hg", 0xb8b8d0}, {NULL, 0}};

/* The fields of a label, of a bond those of its first atom. */
struct atom {
    struct string field[FIELDS];
    size_t fields;
    int is_bond;
};

/* Returns 0 if the text is no label of an atom or bond. */
static int read_atom(struct string label, struct atom *atom)
{
    const char *const end = end_of(label), *begin = label.text;
    memset(atom, 0, sizeof *atom);
    for (const char *p = begin; p <= end && !atom->is_bond; p++) {
        atom->is_bond = end - p >= 2 && p[0] == '-' && p[1] == '-';
        if (p < end && *p != ':' && !atom->is_bond)
            continue;
        if (atom->fields == FIELDS)
            return 0;
        atom->field[atom->fields++] = between(begin, p);
        begin = p + 1;
    }
    return atom->field[3].length > 0;
}

/* The element, or the first letter of the atom's name. */
static struct string element_of(const struct atom *atom)
{
    struct string name = atom->field[3];
    if (atom->fields == FIELDS)
        return atom->field[4];
    while (name.length > 1 && strchr("0123456789'\"*", *name.text)) {
        name.text++;
        name.length--;
    }
    return (struct string){name.text, 1};
}

int colour_of_element(struct string label, uint32_t *colour)
{
    struct atom atom;
    if (!read_atom(label, &atom))
        return 0;
    const int i = find_word(WORDS(elements), element_of(&atom));
    *colour = atom.is_bond     ? BOND
              : i == NOT_GIVEN ? OTHER_ELEMENT
                               : elements[i].colour;
    return 1;
}

int chain_of(struct string label, struct string *chain)
{
    struct atom atom;
    const int is_atom = read_atom(label, &atom);
    *chain = atom.field[0];
    return is_atom;
}
