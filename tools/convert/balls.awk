# balls.awk - the atoms of a molecule as spheres
#
# The radius is the given fraction of the atom's van der Waals radius.  The label
# is the serial number of the atom:
#
#     sphere x y z  radius  serial

# Van der Waals radii in angstrom.  Main group: M. Mantina, A. C. Chamberlin,
# R. Valero, C. J. Cramer and D. G. Truhlar, "Consistent van der Waals Radii for
# the Whole Main Group", J. Phys. Chem. A 113 (2009) 5806-5812, table 12; most of
# it is by A. Bondi, J. Phys. Chem. 68 (1964) 441-451.  Transition metals:
# S. Alvarez, "A cartography of the van der Waals territories", Dalton
# Transactions 42 (2013) 8617-8636.
function prepare_balls(   symbol, size)
{
    read_radii("H 1.10 D 1.10 HE 1.40 LI 1.81 BE 1.53 B 1.92 C 1.70 N 1.55 " \
              "O 1.52 F 1.47 NE 1.54 NA 2.27 MG 1.73 AL 1.84 SI 2.10 " \
              "P 1.80 S 1.80 CL 1.75 AR 1.88 K 2.75 CA 2.31 MN 2.45 " \
              "FE 2.44 CO 2.40 NI 2.40 CU 2.38 ZN 2.39 AS 1.85 SE 1.90 " \
              "BR 1.83 CD 2.49 I 1.98 PT 2.29 AU 2.32 HG 2.45", van_der_waals)
    for (symbol in van_der_waals) {
        size = fraction * van_der_waals[symbol]
        if (!is_finite(size))
            fail("-b", "number too large: " quoted(fraction), 2)
        ball_radius[symbol] = sprintf("%.15g", size)
    }
}

function write_ball(atom)
{
    print "sphere", x[atom], y[atom], z[atom], ball_radius[element[atom]],
          serial[atom]
}
