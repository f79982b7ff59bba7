# bonds.awk - the bonds between atoms, by distance
#
# Two atoms are bonded if their distance is at least 0.4 angstrom and at most
# the sum of their covalent radii [Cordero et al. 2008] plus 0.45 angstrom, the
# usual tolerance.  Two hydrogens are never bonded.  Each bond gives one
# cylinder of the given radius, unless this is 0.  Its label is the serial
# numbers of the atoms:
#
#     cylinder x0 y0 z0  x1 y1 z1  radius  serial0-serial1

function prepare_bonds()
{
    name_covalent_radii()
    allowance = 0.45
    closest = 0.4
}

# Covalent radii in angstrom: B. Cordero et al., "Covalent radii revisited",
# Dalton Transactions 2008, 2832-2838, table 2.
function name_covalent_radii(   symbol)
{
    read_radii("H 0.31 D 0.31 HE 0.28 LI 1.28 BE 0.96 B 0.84 C 0.76 N 0.71 " \
              "O 0.66 F 0.57 NE 0.58 NA 1.66 MG 1.41 AL 1.21 SI 1.11 " \
              "P 1.07 S 1.05 CL 1.02 AR 1.06 K 2.03 CA 1.76 MN 1.39 " \
              "FE 1.32 CO 1.26 NI 1.24 CU 1.32 ZN 1.22 AS 1.19 SE 1.20 " \
              "BR 1.20 CD 1.44 I 1.39 PT 1.36 AU 1.36 HG 1.32", covalent)
    for (symbol in covalent)
        if (covalent[symbol] > largest)
            largest = covalent[symbol]
}

# Reads "SYMBOL RADIUS SYMBOL RADIUS ..." into an array.
function read_radii(text, radii,   i, n, words)
{
    n = split(text, words, " ")
    for (i = 1; i < n; i += 2)
        radii[words[i]] = words[i + 1]
}

function forget_atoms()
{
    split("", cell)
    split("", chosen)
    atoms = 0
}

# Returns whether an atom has the first alternate location of its residue; ""
# means that there is none.
function is_chosen(residue, alternate)
{
    if (alternate == "")
        return 1
    if (!(residue in chosen))
        chosen[residue] = alternate
    return chosen[residue] == alternate
}

function add_atom(number, symbol, ax, ay, az)
{
    if (!(symbol in covalent))
        refuse(here(), "no covalent radius is known for " quoted(symbol))
    atoms++
    serial[atoms] = number
    element[atoms] = symbol
    x[atoms] = ax
    y[atoms] = ay
    z[atoms] = az
    if (balls)
        write_ball(atoms)
    if (radius > 0)
        bond_with_neighbours(atoms)
}

# Cells as wide as the longest bond: the partners of an atom are in 27 cells.
function bond_with_neighbours(new,   i, j, k, m, n, width, near, count,
                              others)
{
    width = 2 * largest + allowance
    i = floor(x[new] / width)
    j = floor(y[new] / width)
    k = floor(z[new] / width)
    for (m = 0; m < 27; m++) {
        near = (i + m % 3 - 1) "," (j + int(m / 3) % 3 - 1) "," \
               (k + int(m / 9) - 1)
        if (!(near in cell))
            continue
        count = split(cell[near], others, " ")
        for (n = 1; n <= count; n++)
            bond(others[n], new)
    }
    cell[i "," j "," k] = cell[i "," j "," k] " " new
}

function floor(value,   whole)
{
    whole = int(value)
    return whole > value ? whole - 1 : whole
}

function bond(first, second,   squared, reach)
{
    if (is_hydrogen(first) && is_hydrogen(second))
        return
    squared = (x[first] - x[second]) ^ 2 + (y[first] - y[second]) ^ 2 + \
              (z[first] - z[second]) ^ 2
    reach = covalent[element[first]] + covalent[element[second]] + allowance
    if (squared >= closest ^ 2 && squared <= reach ^ 2)
        print "cylinder", x[first], y[first], z[first], x[second], y[second],
              z[second], radius, serial[first] "-" serial[second]
}

function is_hydrogen(atom)
{
    return element[atom] == "H" || element[atom] == "D"
}
