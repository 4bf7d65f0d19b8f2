// SPDX-License-Identifier: MIT

#include "json_object.hpp"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace
{

// Nobody nests deeper.
constexpr int levels_most = 64;

struct NotJson : std::runtime_error
{
    NotJson() : std::runtime_error("not JSON")
    {
    }
};

class JsonReader
{
public:
    explicit JsonReader(const std::string &from) : text(from)
    {
    }

    JsonObject read()
    {
        JsonObject object = read_object(0);
        skip_blanks();
        require(at == text.size());
        return object;
    }

private:
    static void require(bool good)
    {
        if (!good)
        {
            throw NotJson();
        }
    }

    void skip_blanks()
    {
        at = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
    }

    // The next character behind blanks, '\0' behind the last.
    char next()
    {
        skip_blanks();
        return at < text.size() ? text[at] : '\0';
    }

    bool take(char wanted)
    {
        const bool is_it = next() == wanted;
        at += is_it ? 1 : 0;
        return is_it;
    }

    unsigned read_code()
    {
        require(at + 4 <= text.size());
        const std::string digits = text.substr(at, 4);
        require(digits.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos);
        at += 4;
        return static_cast<unsigned>(std::strtoul(digits.c_str(), nullptr, 16));
    }

    // In UTF-8; two halves of a character beyond 65535 stay two.
    static std::string letter_of(unsigned code)
    {
        const auto byte = [](unsigned value) { return static_cast<char>(value); };
        if (code < 0x80)
        {
            return std::string(1, byte(code));
        }
        if (code < 0x800)
        {
            return {byte(0xc0 | code >> 6), byte(0x80 | (code & 0x3f))};
        }
        return {byte(0xe0 | code >> 12), byte(0x80 | (code >> 6 & 0x3f)),
                byte(0x80 | (code & 0x3f))};
    }

    std::string read_escape()
    {
        static const std::string letters = "\"\\/bfnrt";
        static const std::string meanings = "\"\\/\b\f\n\r\t";
        require(at < text.size());
        const char letter = text[at++];
        if (letter == 'u')
        {
            return letter_of(read_code());
        }
        const std::size_t which = letters.find(letter);
        require(which != std::string::npos);
        return std::string(1, meanings[which]);
    }

    std::string read_text()
    {
        require(take('"'));
        std::string result;
        while (true)
        {
            require(at < text.size() && static_cast<unsigned char>(text[at]) >= ' ');
            const char letter = text[at++];
            if (letter == '"')
            {
                return result;
            }
            result += letter == '\\' ? read_escape() : std::string(1, letter);
        }
    }

    // A number, true, false or null.
    std::string read_word()
    {
        const std::size_t begin = at;
        at = std::min(text.find_first_of(" \t\r\n,]}", at), text.size());
        const std::string word = text.substr(begin, at - begin);
        const bool name = word == "true" || word == "false" || word == "null";
        require(name ||
                (!word.empty() && word.find_first_not_of("0123456789+-.eE") == std::string::npos));
        return name ? "" : word;
    }

    void read_array(int level, std::vector<std::string> *values)
    {
        require(take('['));
        if (take(']'))
        {
            return;
        }
        do
        {
            const bool nested = next() == '[';
            read_value(level + 1, nested ? nullptr : values);
        } while (take(','));
        require(take(']'));
    }

    void read_value(int level, std::vector<std::string> *values)
    {
        require(level < levels_most);
        const char first = next();
        if (first == '{')
        {
            read_object(level + 1);
        }
        else if (first == '[')
        {
            read_array(level, values);
        }
        else
        {
            const std::string value = first == '"' ? read_text() : read_word();
            if (values != nullptr && (first == '"' || !value.empty()))
            {
                values->push_back(value);
            }
        }
    }

    JsonObject read_object(int level)
    {
        JsonObject object;
        require(take('{'));
        if (take('}'))
        {
            return object;
        }
        do
        {
            const std::string key = read_text();
            require(take(':'));
            std::vector<std::string> values;
            read_value(level, &values);
            object[key] = values;
        } while (take(','));
        require(take('}'));
        return object;
    }

    const std::string &text;
    std::size_t at = 0;
};

} // namespace

std::optional<JsonObject> read_json_object(const std::string &text)
{
    try
    {
        return JsonReader(text).read();
    }
    catch (const NotJson &)
    {
        return std::nullopt;
    }
}
