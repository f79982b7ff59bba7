# mmcif.awk - the atoms of an mmCIF file
#
# A file is a sequence of tokens: names of items, values and keywords such as
# data_ and loop_.  After `loop_` come the names of its columns, then rows of
# values, which may continue over lines.  A value may be quoted, or it may be a
# text of several lines between lines that begin with `;`.  The category
# _atom_site has one row for each atom; for one atom there may be no loop.
# [Hall, Allen and Brown 1991, "The Crystallographic Information File"]

# state: the tokens that may follow.  "": names of single items; "names": names
# of a loop; "values": values of a loop.
function begin_mmcif()
{
    state = pending = ""
    in_text = columns = 0
    forget_row()
}

function end_mmcif()
{
    if (in_text)
        refuse(text_place, "the text that begins here has no end")
    end_category()
}

function read_mmcif_line(text)
{
    if (in_text && text !~ /^;/) {
        value = value "\n" text
        return
    }
    if (text ~ /^;/) {
        in_text = !in_text
        if (in_text) {
            value = substr(text, 2)
            text_place = here()
            return
        }
        text = substr(text, 2)
        take_value(value)
    }
    while (match(text, /[^ \t]/) && substr(text, RSTART, 1) != "#")
        text = take_token(substr(text, RSTART))
}

# Reads the token at the beginning of the text.  Returns the rest of the text.
function take_token(text,   quote, i, token)
{
    quote = substr(text, 1, 1)
    if (quote == "\"" || quote == "'") {
        for (i = 2; i <= length(text); i++)
            if (substr(text, i, 1) == quote && \
                substr(text, i + 1) ~ /^([ \t]|$)/) {
                take_value(substr(text, 2, i - 2))
                return substr(text, i + 1)
            }
        refuse_found("the quote that ends the value", text)
    }
    match(text, /^[^ \t]+/)
    token = substr(text, 1, RLENGTH)
    text = substr(text, RLENGTH + 1)
    if (token ~ /^_/)
        take_name(tolower(token))
    else if (tolower(token) ~ /^(loop_|stop_|global_)$|^(data_|save_)/)
        take_word(tolower(token))
    else
        take_value(token)
    return text
}

function take_word(token)
{
    end_category()
    if (token ~ /^data_/ && atoms > 0)
        model_ended = 1
    if (token == "loop_") {
        state = "names"
        columns = 0
    }
}

function take_name(name)
{
    if (state == "names") {
        column_name[++columns] = name
        filled = 0
        return
    }
    if (state == "values" || name !~ /^_atom_site\./)
        end_category()
    pending = name
}

function take_value(text)
{
    if (state == "") {
        set_item(pending, text)
        single = pending ~ /^_atom_site\./
        return
    }
    if (columns == 0)
        refuse_found("an item's name after loop_", text)
    state = "values"
    set_item(column_name[++filled], text)
    if (filled == columns)
        end_row()
}

function set_item(name, text)
{
    if (name ~ /^_atom_site\./)
        item[substr(name, length("_atom_site.") + 1)] = text
}

# Ends a loop or a sequence of single items.
function end_category()
{
    if (state == "values" && filled > 0)
        refuse(here(), "the loop ends within a row: " filled " of " columns \
               " values")
    if (state == "" && single)
        end_row()
    state = ""
    single = 0
}

function end_row()
{
    if (column_name[1] ~ /^_atom_site\./ || single)
        take_atom()
    forget_row()
}

function forget_row()
{
    split("", item)
    filled = single = 0
}

function take_atom(   ax, ay, az)
{
    if (model_ended || !is_first_model())
        return
    if (!is_chosen(item_of("auth_asym_id", "label_asym_id") " " \
                   item_of("auth_seq_id", "label_seq_id") " " \
                   item_of("pdbx_pdb_ins_code", ""),
                   item_of("label_alt_id", "")))
        return
    ax = cartesian("x")
    ay = cartesian("y")
    az = cartesian("z")
    add_atom(item_of("id", ""), element_of_item(), ax, ay, az)
}

# Returns the value of an item, or of the other if it is unknown; "" if both are.
function item_of(name, other)
{
    if (name in item && item[name] != "." && item[name] != "?")
        return item[name]
    return other == "" ? "" : item_of(other, "")
}

function is_first_model(   model)
{
    model = item_of("pdbx_pdb_model_num", "")
    if (atoms == 0)
        first_model = model
    return model == first_model
}

function cartesian(axis,   text)
{
    text = item_of("cartn_" axis, "")
    sub(/\([0-9]+\)$/, "", text) # the standard uncertainty
    if (!is_number(text))
        refuse_found("a number for _atom_site.Cartn_" axis, text)
    return text
}

# Without type_symbol the element is read from the atom's name: all its letters
# if the residue has the same name, otherwise the first.
function element_of_item(   name)
{
    name = toupper(item_of("type_symbol", ""))
    if (name == "") {
        name = toupper(item_of("label_atom_id", "auth_atom_id"))
        gsub(/[^A-Z]/, "", name)
        if (name != toupper(item_of("label_comp_id", "auth_comp_id")))
            name = substr(name, 1, 1)
    }
    return name
}
