# pdb.awk - molecules in PDB or mmCIF: a cylinder for each bond, and a sphere
# for each atom if `balls`
#
# The first line that is neither blank nor a comment shows which of the two a
# file is: mmCIF begins with `data_`, `loop_` or an item's name.  Only the first
# model is read, and only the first alternate location in each residue.  A file
# without atoms is refused.

BEGIN {
    if (!is_number(radius) || radius < 0 || (radius == 0 && !balls))
        fail("-r", "expected a positive number" (balls ? " or 0" : "") \
             ", found " quoted(radius), 2)
    if (!is_number(fraction) || fraction <= 0)
        fail("-b", "expected a positive number, found " quoted(fraction), 2)
    prepare_bonds()
    prepare_balls()
    convert_files()
}

function begin_file()
{
    forget_atoms()
    format = ""
    model_ended = 0
    begin_mmcif()
}

function read_line(text)
{
    if (format == "" && text !~ /^[ \t]*(#|$)/)
        format = tolower(text) ~ /^[ \t]*(data_|loop_|_[a-z])/ ? "mmcif" : "pdb"
    if (format == "mmcif")
        read_mmcif_line(text)
    else if (text ~ /^ENDMDL/)
        model_ended = 1
    else if (text ~ /^(ATOM  |HETATM)/ && !model_ended)
        read_pdb_atom(text)
}

function end_file()
{
    end_mmcif()
    if (atoms == 0)
        refuse(file, "no atom was found")
}

function finish()
{
}

# --------------------------------------------------------------------- PDB --

function read_pdb_atom(text,   ax, ay, az)
{
    if (!is_chosen(substr(text, 22, 6), bare(substr(text, 17, 1))))
        return
    ax = coordinate(text, 31)
    ay = coordinate(text, 39)
    az = coordinate(text, 47)
    add_atom(bare(substr(text, 7, 5)), element_of_line(text), ax, ay, az)
}

function coordinate(text, first,   number)
{
    number = bare(substr(text, first, 8))
    if (!is_number(number))
        refuse_found("a number in columns " first " to " first + 7, number)
    return number
}

function bare(text)
{
    gsub(/[ \t]/, "", text)
    return text
}

# The element is in columns 77 and 78.  If it is missing, it is read from the
# first two columns of the atom's name, right-aligned.
function element_of_line(text,   name)
{
    name = toupper(bare(substr(text, 77, 2)))
    if (name == "") {
        name = toupper(bare(substr(text, 13, 2)))
        gsub(/[^A-Z]/, "", name)
        if (!(name in covalent))
            name = substr(name, 1, 1)
    }
    return name
}
